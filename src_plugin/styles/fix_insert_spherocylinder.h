// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>
#include <vector>

#include "fix_insert_pack.h"
#include "fix_insert_rate_region.h"
#include "fix_insert_stream.h"

namespace LAMMPS_NS {

// The arguments of an insertion command as LIGGGHTS shall see them: each number is one, and the
// quaternion of `orientation constant` has unit length to the last digit, which LIGGGHTS insists
// on.
class InsertionArguments {
 public:
  InsertionArguments(LAMMPS *lmp, int narg, char **arg);
  int count() const { return static_cast<int>(pointers_.size()); }
  char **values() { return pointers_.data(); }

 private:
  std::vector<std::string> words_;
  std::vector<char *> pointers_;
};

// Of where an insertion may place centres, the part that is nearer than a rod's bounding radius to
// a face of a rank's subdomain. LIGGGHTS draws no centres there.
class InsertionNearFaces {
 public:
  virtual ~InsertionNearFaces() = default;
  virtual double share_near_faces(double bounding_radius) const = 0;  // called by all ranks
};

// LIGGGHTS's insertion commands, where they would take a rod for its bounding sphere or for a point
// that does not turn. In a simulation with fibres all ranks place together (styles/place_together.h).
template <typename Insertion>  // FixInsertPack or FixInsertRateRegion
class InsertionInRegion : public Insertion, public InsertionNearFaces {
 public:
  InsertionInRegion(LAMMPS *lmp, InsertionArguments arguments);
  void init() override;
  void pre_exchange() override;
  double share_near_faces(double bounding_radius) const override;

 protected:
  void x_v_omega(int wanted, int &placed, int &rods, double &mass) override;
};

class FixInsertPackSpherocylinder : public InsertionInRegion<FixInsertPack> {
 public:
  using InsertionInRegion::InsertionInRegion;

 protected:
  int calc_ninsert_this() override;
};

class FixInsertRateRegionSpherocylinder : public InsertionInRegion<FixInsertRateRegion> {
 public:
  using InsertionInRegion::InsertionInRegion;
};

class FixInsertStreamSpherocylinder : public FixInsertStream, public InsertionNearFaces {
 public:
  FixInsertStreamSpherocylinder(LAMMPS *lmp, InsertionArguments arguments);
  void init() override;
  void pre_exchange() override;
  void end_of_step() override;
  // LIGGGHTS draws points to find out a rank's share of the stream before it first inserts in a run.
  void find_out_share() { insertion_fraction(); }
  double share_near_faces(double bounding_radius) const override;

 protected:
  void x_v_omega(int wanted, int &placed, int &rods, double &mass) override;
  void finalize_insertion(int rods) override;
};

}  // namespace LAMMPS_NS
