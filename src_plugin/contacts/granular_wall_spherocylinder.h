// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <deque>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "contacts/contact_laws.h"
#include "contacts/contact_monitor.h"
#include "contacts/contact_observer.h"
#include "contacts/gather_mesh.h"
#include "contacts/gather_walls.h"
#include "contacts/rod_wall.h"

namespace LAMMPS_NS {

class ContactState;
class RodThreads;

// What the stock fix wall/gran runs for rods. Contacts of the two ends of a rod with a plane or the inside
// of a cylinder: between its ends a straight rod cannot be nearer to either, so the two end spheres are the
// whole contact; each has its own history. Contacts with meshes: see spherocylinder::find_contacts.
class GranularWallSpherocylinder : private Pointers, public RodWall {
 public:
  GranularWallSpherocylinder(LAMMPS *lmp, FixWallGran *parent, std::unique_ptr<StockLaw> models);

  void settings(int nargs, char **args, LIGGGHTS::IContactHistorySetup *history) override;
  void init_granular() override;
  bool checkSurfaceIntersect(LIGGGHTS::ContactModels::SurfacesIntersectData &) override
  {
    return true;
  }
  int get_history_offset(std::string name) override { return laws_.models().history_offset(name); }
  bool contact_match(const std::string type, const std::string model) override
  {
    return laws_.models().is(type, model);
  }

  void compute_forces(FixWallGran &fix, const MovingWall &wall, const std::vector<int> &rods,
                      double **history) override;
  void contacts_ended(int i, double *history) override;
  void compute_mesh_forces(FixWallGran &fix, const MeshSurface &mesh, int number,
                           const RodsNearMesh &rods, bool is_new,
                           MeshHistories &histories) override;
  int history_values() override { return laws_.models().layout().values(); }
  int64_t hashcode() override { return laws_.models().hashcode(); }

  // For the loop of LIGGGHTS's own fix, which the rods' fix does not run.
  void compute_force(FixWallGran *, LIGGGHTS::ContactModels::SurfacesIntersectData &, bool,
                     double *, FixMeshSurface *, int, TriMesh *, int) override;

 private:
  FixWallGran *parent_;
  ContactLaws laws_;
  WallGatherer gatherer_;
  std::deque<MeshGatherer> mesh_gatherers_;  // one a thread
  std::set<int> told_of_pierced_;            // meshes
  // What a thread works with.
  struct alignas(spherocylinder::kCacheLine) Worker {
    ContactBatch batch;
    ContactMonitor::Seen seen;
  };
  std::vector<Worker> workers_;
  const RodThreads *threads_ = nullptr;  // these four: attached to the rods
  ContactMonitor *monitor_ = nullptr;
  const ContactState *state_ = nullptr;
  JointShares *joint_shares_ = nullptr;
  const JointShares *shares_ = nullptr;  // of this step, null without fibres

  // What a thread does with a part of the rods near a wall.
  void work_out(int thread, const int *rods, int count, MovingWall wall, double **history,
                bool adds_forces, const ContactObservers &observers);
  // The same with near rods of a mesh, and all rods from first_rod on and below next_rod.
  void work_out_mesh(int thread, const RodsNearMesh::Near *begin, const RodsNearMesh::Near *end,
                     int first_rod, int next_rod, bool is_new, bool adds_forces,
                     const ContactObservers &observers);
  void warn_of_pierced(const FixWallGran &fix, const MeshSurface &mesh, int number);
  // Of a rod's row of history, values of an end each: end 0 first.
  static EndHistories of_ends(double *row, int values)
  {
    return row ? EndHistories{row, row + values} : EndHistories{nullptr, nullptr};
  }
  void finish_batch(int thread, bool adds_forces, const ContactObservers &observers);
  void take_what_was_seen();
};

}  // namespace LAMMPS_NS
