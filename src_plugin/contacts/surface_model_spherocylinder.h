// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef SURFACE_MODEL
SURFACE_MODEL(SURFACE_SPHEROCYLINDER, spherocylinder, 20)
#else
#ifndef SURFACE_MODEL_SPHEROCYLINDER_H_
#define SURFACE_MODEL_SPHEROCYLINDER_H_

#include "atom.h"
#include "contact_models.h"
#include "contacts/history_layout.h"
#include "surface_model_base.h"

namespace LIGGGHTS {
namespace ContactModels {

// A rod in contact is a sphere of the rod's radius whose centre sits on the rod's axis, at the
// point nearest to the partner. The law that calls this model (StockLawOf) fills sidata:
//   v_i, v_j   velocity of the points on the axes (not of the rods' centres)
//   en         unit normal, towards rod i
//   r          distance of the points along en (negative once the axes have passed each other)
//   cri, crj   distances of the points on the axes from the contact point, midway in the overlap
//   radi, radj, deltan, meff (effective mass at the contact)
// This model turns them into the relative velocity at the contact point, by the same formulas as
// LIGGGHTS's default surface model.
template <>
class SurfaceModel<SURFACE_SPHEROCYLINDER> : public SurfaceModelBase {
 public:
  SurfaceModel(LAMMPS *lmp, IContactHistorySetup *hsetup, class ContactModelBase *cmb)
      : SurfaceModelBase(lmp, hsetup, cmb)
  {
  }

  void registerSettings(Settings &) {}

  // Which side of each other two rods are on is remembered where the other models ask for a
  // history anyway, so that rods whose axes are driven past each other are pushed back.
  void postSettings(IContactHistorySetup *hsetup, ContactModelBase *cmb)
  {
    auto *layout = dynamic_cast<LAMMPS_NS::HistoryLayout *>(hsetup);
    if (cmb->is_wall() || !layout || layout->values() == 0) return;
    const int offset = hsetup->add_history_value("rod_normal_x", "1");
    hsetup->add_history_value("rod_normal_y", "1");
    hsetup->add_history_value("rod_normal_z", "1");
    cmb->add_history_offset("rod_normal", offset);
  }

  void connectToProperties(PropertyRegistry &) {}

  inline bool checkSurfaceIntersect(SurfacesIntersectData &) { return true; }

  inline void surfacesIntersect(SurfacesIntersectData &sidata, ForceData &, ForceData &)
  {
    const double *en = sidata.en, *wi = sidata.omega_i, *wj = sidata.omega_j;
    double vr[3], spin[3];  // spin: cri w_i + crj w_j
    for (int d = 0; d < 3; d++) {
      vr[d] = sidata.v_i[d] - sidata.v_j[d];
      spin[d] = sidata.cri * wi[d];
      if (!sidata.is_wall) spin[d] += sidata.crj * wj[d];
    }
    sidata.vn = vr[0] * en[0] + vr[1] * en[1] + vr[2] * en[2];
    // The surface point of rod i is at -cri en from its axis and moves with w_i x (-cri en).
    sidata.vtr1 = vr[0] - sidata.vn * en[0] + en[1] * spin[2] - en[2] * spin[1];
    sidata.vtr2 = vr[1] - sidata.vn * en[1] + en[2] * spin[0] - en[0] * spin[2];
    sidata.vtr3 = vr[2] - sidata.vn * en[2] + en[0] * spin[1] - en[1] * spin[0];
    sidata.wr1 = spin[0] * sidata.rinv;
    sidata.wr2 = spin[1] * sidata.rinv;
    sidata.wr3 = spin[2] * sidata.rinv;
    sidata.P_diss = 0.0;
  }

  inline void endSurfacesIntersect(SurfacesIntersectData &, TriMesh *, double *const) {}
  inline void surfacesClose(SurfacesCloseData &, ForceData &, ForceData &) {}
  void beginPass(SurfacesIntersectData &, ForceData &, ForceData &) {}
  void endPass(SurfacesIntersectData &, ForceData &, ForceData &) {}
  inline void tally_pp(double, int, int, int) {}
  inline void tally_pw(double, int, int, int) {}
};

}  // namespace ContactModels
}  // namespace LIGGGHTS

#endif
#endif
