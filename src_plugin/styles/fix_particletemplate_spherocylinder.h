// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef FIX_CLASS

FixStyle(particletemplate/spherocylinder, FixParticletemplateSpherocylinder)

#else

#ifndef LMP_FIX_PARTICLETEMPLATE_SPHEROCYLINDER_H
#define LMP_FIX_PARTICLETEMPLATE_SPHEROCYLINDER_H

#include "core/fibre_shape.h"
#include "fix_template_sphere.h"

namespace LAMMPS_NS {

class ParticleToInsertSpherocylinder;

// A rod for LIGGGHTS's insertion commands, or a fibre of equal segments: one diameter, one total length, one
// density. Mixtures are made of several templates in one particledistribution/discrete.
class FixParticletemplateSpherocylinder : public FixTemplateSphere {
 public:
  FixParticletemplateSpherocylinder(LAMMPS *lmp, int narg, char **arg);
  ~FixParticletemplateSpherocylinder() override;
  void post_create() override;
  void init() override;

  double min_rad() override;
  double max_rad() override;
  double max_r_bound() override;
  void randomize_single() override;
  void init_ptilist(int n_random_max, const bool enforce_single,
                    FixPropertyAtom *const fix_release) override;
  void delete_ptilist() override;
  void randomize_ptilist(int n_random, int distribution_groupbit, int distorder) override;
  void direct_set_ptlist(const int i, const void *const data, const int distribution_groupbit,
                         const int distorder) override;
  unsigned int generate_hash() override;
  void finalize_insertion() override;
  int number_spheres() override { return static_cast<int>(shape_.segments.size()); }

  bool makes_fibres() const { return shape_.segments.size() > 1; }

 private:
  double diameter_ = 0.0;      // m
  double total_length_ = 0.0;  // m
  double density_ = 0.0;       // kg/m^3
  spherocylinder::FibreShape shape_;
  double bounding_radius_ = 0.0;
  Region *container_ = nullptr;
  int requested_ = 0;  // rods this rank was asked for in the insertion under way

  void parse_rod_keywords(int narg, char **arg);
  void make_shape(int segments, double curvature, double twist);
  void check_container_is_large_enough() const;
  void describe(ParticleToInsertSpherocylinder &rod) const;
};

}  // namespace LAMMPS_NS

#endif
#endif
