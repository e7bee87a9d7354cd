// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "contacts/contact_batch.h"
#include "contacts/contact_monitor.h"
#include "contacts/gather_walls.h"
#include "contacts/rod_keywords.h"
#include "contacts/scatter.h"
#include "contacts/stock_models.h"
#include "contacts/vector_law.h"
#include "walls/rod_wall.h"

namespace LAMMPS_NS {

// What the stock fix wall/gran runs for rods: contacts of the two ends of a rod with a plane or the
// inside of a cylinder. Between its ends a straight rod cannot be nearer to either, so the two end
// spheres are the whole contact; each has its own history.
class GranularWallSpherocylinder : private Pointers, public RodWall {
 public:
  GranularWallSpherocylinder(LAMMPS *lmp, FixWallGran *parent, std::unique_ptr<StockModels> models);

  void settings(int nargs, char **args, LIGGGHTS::IContactHistorySetup *history) override;
  void init_granular() override;
  bool checkSurfaceIntersect(LIGGGHTS::ContactModels::SurfacesIntersectData &) override
  {
    return true;
  }
  int get_history_offset(std::string name) override { return models_->history_offset(name); }
  bool contact_match(const std::string type, const std::string model) override
  {
    return models_->is(type, model);
  }

  void compute_forces(FixWallGran &fix, const MovingWall &wall, const std::vector<int> &rods,
                      double **history) override;
  void part(int i, double *history) override;

  // For the loop of LIGGGHTS's own fix, which the rods' fix does not run.
  void compute_force(FixWallGran *, LIGGGHTS::ContactModels::SurfacesIntersectData &, bool,
                     double *, FixMeshSurface *, int, TriMesh *, int) override;

 private:
  FixWallGran *parent_;
  std::unique_ptr<StockModels> models_;
  VectorLaw vector_law_;
  ContactLaw *law_;  // vector_law_ where it serves, else models_
  RodKeywords keywords_;
  WallGatherer gatherer_;
  ContactBatch batch_;
  ContactMonitor monitor_;

  void finish_batch(bool adds_forces, const ContactObservers &observers);
};

}  // namespace LAMMPS_NS
