// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef NORMAL_MODEL
NORMAL_MODEL(NORMAL_LINEAR, linear, 20)
#else
#ifndef NORMAL_MODEL_LINEAR_H_
#define NORMAL_MODEL_LINEAR_H_

#include "contact_models.h"
#include "contacts/aspect_scale.h"
#include "contacts/linear_keywords.h"
#include "core/linear_law.h"
#include "normal_model_base.h"

namespace LIGGGHTS {
namespace ContactModels {

// Spring and dashpot with explicit stiffness:
//   F_n = kn * overlap - gamma_n * v_n,   gamma_n = 2 beta sqrt(kn m_eff),
//   beta = -ln e / sqrt(pi^2 + ln^2 e)   (so that a pair parts with e times its approach velocity)
// and kt, gamma_t = 2 beta sqrt(kt m_eff) for the tangential model. m_eff is the effective mass at
// the contact. With aspect_scaling on, kn and kt are multiplied by the rods' aspect ratio (two
// rods: by the harmonic mean, as two springs in series), which multiplies the damping of rods of
// one thickness by the aspect ratio too, since their mass grows with it.
template <>
class NormalModel<NORMAL_LINEAR> : public NormalModelBase {
 public:
  NormalModel(LAMMPS *lmp, IContactHistorySetup *hsetup, class ContactModelBase *c)
      : NormalModelBase(lmp, hsetup, c)
  {
  }

  void registerSettings(Settings &settings) { LAMMPS_NS::register_on_off(settings, keywords_); }

  void postSettings(IContactHistorySetup *, ContactModelBase *) {}

  void connectToProperties(PropertyRegistry &registry)
  {
    registry.registerProperty("k_n", &MODEL_PARAMS::createKn);
    registry.registerProperty("k_t", &MODEL_PARAMS::createKt);
    registry.registerProperty("betaeff", &MODEL_PARAMS::createBetaEff);
    registry.connect("k_n", kn_, "model linear");
    registry.connect("k_t", kt_, "model linear");
    registry.connect("betaeff", beta_, "model linear");  // negative: ln e / sqrt(...)
    if (force->cg_active()) error->cg(FLERR, "model linear");
    check_properties(registry.max_type());
  }

  double stressStrainExponent() { return 1.0; }

  inline void surfacesIntersect(SurfacesIntersectData &sidata, ForceData &i_forces,
                                ForceData &j_forces)
  {
    if (sidata.contact_flags) *sidata.contact_flags |= CONTACT_NORMAL_MODEL;

    const int j = sidata.is_wall ? -1 : sidata.j;
    const double scale =
        keywords_.aspect_scaling ? LAMMPS_NS::aspect_scale(*atom, sidata.i, j) : 1.0;
    const double kn = scale * kn_[sidata.itype][sidata.jtype];
    const double kt = scale * kt_[sidata.itype][sidata.jtype];
    const double two_beta = -2.0 * beta_[sidata.itype][sidata.jtype];
    const double gamman = two_beta * sqrt(kn * sidata.meff);

    const double Fn =
        spherocylinder::normal_force(kn, sidata.deltan, gamman, sidata.vn, keywords_.limit_force);

    sidata.Fn = Fn;
    sidata.kn = kn;
    sidata.kt = kt;
    sidata.gamman = gamman;
    sidata.gammat = keywords_.tangential_damping ? two_beta * sqrt(kt * sidata.meff) : 0.0;

    for (int d = 0; d < 3; d++) {
      const double F = Fn * sidata.en[d];
      i_forces.delta_F[d] += F;
      if (!sidata.is_wall) j_forces.delta_F[d] -= F;
    }
  }

  void surfacesClose(SurfacesCloseData &scdata, ForceData &, ForceData &)
  {
    if (scdata.contact_flags) *scdata.contact_flags &= ~CONTACT_NORMAL_MODEL;
  }

  void beginPass(SurfacesIntersectData &, ForceData &, ForceData &) {}
  void endPass(SurfacesIntersectData &, ForceData &, ForceData &) {}

 private:
  double **kn_ = nullptr;
  double **kt_ = nullptr;
  double **beta_ = nullptr;
  LAMMPS_NS::LinearKeywords keywords_{};

  void check_properties(int max_type)
  {
    for (int i = 1; i <= max_type; i++)
      for (int j = 1; j <= max_type; j++) {
        if (kn_[i][j] > 0.0 && kt_[i][j] >= 0.0) continue;
        char text[200];
        snprintf(text, sizeof(text),
                 "Model linear: kn must be > 0 and kt >= 0 (got kn %g and kt %g for atom types "
                 "%d and %d)",
                 kn_[i][j], kt_[i][j], i, j);
        error->all(FLERR, text);
      }
  }
};

}  // namespace ContactModels
}  // namespace LIGGGHTS

#endif
#endif
