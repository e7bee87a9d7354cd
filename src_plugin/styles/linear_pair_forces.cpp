// SPDX-License-Identifier: GPL-2.0-or-later
#include "linear_pair_forces.h"

#include <algorithm>

#include "atom.h"
#include "contact_model_headers.h"
#include "neigh_list.h"
#include "pair_gran.h"
#include "rod_pair_geometry.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace spherocylinder;

void LinearPairForces::set_place(int k, const RodPairGeometry &place)
{
  LinearContacts &c = contacts_;
  c.s[k] = place.s;
  c.t[k] = place.t;
  c.normal.set(k, place.normal);
  c.distance[k] = place.distance;
  c.overlap[k] = place.overlap;
  c.share[k] = place.share;
}

void LinearPairForces::set_motion(int k, const Capsule &rod_i, const RodMotion &motion_i,
                                  const Capsule &rod_j, const RodMotion &motion_j)
{
  LinearContacts &c = contacts_;
  c.axis_i.set(k, rod_i.segment.axis);
  c.axis_j.set(k, rod_j.segment.axis);
  c.velocity_i.set(k, motion_i.velocity);
  c.velocity_j.set(k, motion_j.velocity);
  c.omega_i.set(k, motion_i.omega);
  c.omega_j.set(k, motion_j.omega);
}

void LinearPairForces::set_kinds(int k, int i, int j, const Capsule &rod_i,
                                 const InverseInertia &own_i, const Capsule &rod_j,
                                 const InverseInertia &own_j)
{
  LinearContacts &c = contacts_;
  const InverseInertia inverse_i = shown_to(own_j, own_i), inverse_j = shown_to(own_i, own_j);
  c.inverse_mass_i[k] = inverse_i.mass;
  c.inverse_mass_j[k] = inverse_j.mass;
  c.inverse_inertia_i[k] = inverse_i.transverse;
  c.inverse_inertia_j[k] = inverse_j.transverse;
  c.radius_i[k] = rod_i.radius;
  c.radius_j[k] = rod_j.radius;
  // Two spheres keep LIGGGHTS's spring, so that they move as its own do.
  const bool spheres = rod_i.segment.half_length == 0.0 && rod_j.segment.half_length == 0.0;
  c.turning[k] = spheres ? 0.0 : 1.0;
  values_.set(c, k, atom->type[i], atom->type[j],
              values_.aspect_scaling ? mean_aspect_ratio(rod_i, rod_j) : 1.0);
}

// What spread contacts push beside their resultant.
void LinearPairForces::add_spread()
{
  LinearContacts &c = contacts_;
  for (int n = 0; n < spread_count_; n++) {
    const auto &[k, place] = spread_[n];
    const double kn = c.stiffness[k];
    const Vec3 sideways = kn * place.sideways;
    c.force.set(k, c.force.get(k) + sideways);
    c.torque_i.set(k, c.torque_i.get(k) + cross(place.s * c.axis_i.get(k), sideways) +
                          kn * place.couple_i);
    c.torque_j.set(k, c.torque_j.get(k) - cross(place.t * c.axis_j.get(k), sideways) +
                          kn * place.couple_j);
  }
  spread_count_ = 0;
}

void LinearPairForces::compute(PairGran &pair, const TouchingRodPairs &pairs,
                               const std::vector<Capsule> &rods,
                               const std::vector<RodMotion> &motions, const RodKinds &kinds,
                               HistoryOffsets offsets, bool spread, ContactMonitor &monitor,
                               SuddenOverlaps &sudden_overlaps)
{
  int **first_flags = pair.listgranhistory ? pair.listgranhistory->firstneigh : nullptr;
  double **first_history = pair.listgranhistory ? pair.listgranhistory->firstdouble : nullptr;
  constexpr Vec3 kZero = {0.0, 0.0, 0.0};
  const int dnum = pair.dnum(), nlocal = atom->nlocal;
  double **f = atom->f, **torque = atom->torque;
  const bool remember = offsets.side >= 0 && first_history;
  const bool has_spring = offsets.spring >= 0 && first_history;
  const int flag = LIGGGHTS::ContactModels::CONTACT_NORMAL_MODEL |
                   (has_spring ? LIGGGHTS::ContactModels::CONTACT_TANGENTIAL_MODEL : 0);
  LinearContacts &c = contacts_;
  values_.law.dt = update->dt;  // a fix may change it during a run
  if (values_.have_changed()) forget_kinds();

  for (const CloseRodPairs::Entry &entry : pairs.parted()) {
    first_flags[entry.i][entry.index] = 0;
    if (!first_history) continue;
    double *history = &first_history[entry.i][dnum * entry.index];
    if (remember) store(kZero, history + offsets.side);
    if (has_spring) store(kZero, history + offsets.spring);
  }

  const std::vector<TouchingRodPairs::Touch> &touching = pairs.touching();
  for (size_t start = 0; start < touching.size(); start += kBatch) {
    const int count = static_cast<int>(std::min<size_t>(kBatch, touching.size() - start));
    for (int k = 0; k < count; k++) {
      const TouchingRodPairs::Touch &touch = touching[start + k];
      const int i = touch.i, j = touch.j;
      const Capsule &rod_i = rods[i], &rod_j = rods[j];
      const double *history = first_history ? &first_history[i][dnum * touch.index] : nullptr;
      c.side.set(k, remember ? load(history + offsets.side) : kZero);
      c.spring.set(k, has_spring ? load(history + offsets.spring) : kZero);

      // Few contacts need more than their closest points; what geometry_of gives minds the side.
      if (touch.distance == 0.0 || (spread && touch.nearly_parallel)) {
        const RodPairGeometry place = geometry_of(
            touch, rods, atom->tag, remember ? history + offsets.side : nullptr, spread);
        set_place(k, place);
        c.side.set(k, kZero);
        if (spread && touch.nearly_parallel) spread_[spread_count_++] = {k, place};
      } else {
        set_place(k, closest_geometry(touch, rod_i.radius + rod_j.radius));
      }
      set_motion(k, rod_i, motions[i], rod_j, motions[j]);
      const int both = kinds.of_pair(i, j);
      if (both == RodKinds::kNone || both != kinds_in_batch_[k])
        set_kinds(k, i, j, rod_i, motions[i].inverse, rod_j, motions[j].inverse);
      kinds_in_batch_[k] = both;
    }

    linear_contacts(c, values_.law);
    add_spread();

    for (int k = 0; k < count; k++) {
      const TouchingRodPairs::Touch &touch = touching[start + k];
      const int i = touch.i, j = touch.j;
      const double reach = c.radius_i[k] + c.radius_j[k];
      const double depth = c.overlap[k] / reach;
      sudden_overlaps.look(i, j, depth, c.inverse_mass[k] != 0.0);
      if (c.inverse_mass[k] == 0.0) continue;  // both frozen: nothing to move
      if (first_flags) first_flags[i][touch.index] |= flag;
      if (first_history) {
        double *history = &first_history[i][dnum * touch.index];
        if (remember)
          store(remembered_side(c.side.get(k), depth), history + offsets.side);
        if (has_spring) store(c.spring.get(k), history + offsets.spring);
      }
      monitor.look(i, j, c.stiffness[k], c.effective_mass[k], c.overlap[k], reach);
      const Vec3 force = c.force.get(k);
      const double relax_i = pair.relax(i);
      add_to(f[i], relax_i * force);
      add_to(torque[i], relax_i * c.torque_i.get(k));
      if (j >= nlocal) continue;
      const double relax_j = pair.relax(j);
      add_to(f[j], -relax_j * force);
      add_to(torque[j], relax_j * c.torque_j.get(k));
    }
  }
}
