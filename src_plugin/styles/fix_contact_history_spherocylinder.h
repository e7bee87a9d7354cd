// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef LMP_FIX_CONTACT_HISTORY_SPHEROCYLINDER_H
#define LMP_FIX_CONTACT_HISTORY_SPHEROCYLINDER_H

#include "core/rotation.h"
#include "fix_contact_history.h"

namespace LAMMPS_NS {

// fix contacthistory of decks with rods, made by pair_style gran: LIGGGHTS's own, whose rows follow
// the rods while LIGGGHTS hands them from rank to rank or puts them in another order.
//
// Between that the histories are in the pair style's list, by the rods' places in memory. LIGGGHTS
// fetches them from there whenever it is asked to, also when the list is older than the rows; this
// one does so only if forces have been worked out since (the pair style's computeflag), so that
// whoever is about to change the order of rods may ask for it at any time.
//
// The style name is LIGGGHTS's; the loader creates this class for rods and LIGGGHTS's own for
// everything else.
class FixContactHistorySpherocylinder : public FixContactHistory {
 public:
  FixContactHistorySpherocylinder(LAMMPS *lmp, int narg, char **arg);
  void pre_exchange() override;

  // After rods have been deleted or given other ids. `new_id(old)` is 0 for a rod that is gone.
  // Histories must be with their rods.
  template <typename NewId>
  void rename_partners(NewId new_id)
  {
    for (int i = 0; i < rods(); i++) {
      int kept = 0;
      for (int k = 0; k < npartner_[i]; k++) {
        const int id = new_id(partner_[i][k]);
        if (id > 0) move_partner(i, k, kept++, id);
      }
      npartner_[i] = kept;
    }
  }

  // After rods, those whose id `is_turned(id)`, have been turned as one body by `rotation`. What two of
  // them keep of their contact turns with them; a contact with a rod that has not been turned is
  // forgotten. Returns how many, one for each of the two rods. Histories must be with their rods.
  template <typename IsTurned>
  int turn(const spherocylinder::Quaternion &rotation, IsTurned is_turned)
  {
    int forgotten = 0;
    for (int i = 0; i < rods(); i++) {
      const bool turned = is_turned(id_of(i));
      int kept = 0;
      for (int k = 0; k < npartner_[i]; k++) {
        const int partner = partner_[i][k];
        if (is_turned(partner) != turned) continue;
        if (turned) turn_vectors(contacthistory(i, k), rotation);
        move_partner(i, k, kept++, partner);
      }
      forgotten += npartner_[i] - kept;
      npartner_[i] = kept;
    }
    return forgotten;
  }

  // Rod `to` begins with the contacts of rod `from`, its partners' ids higher by `shift`. (LIGGGHTS lets
  // a copied atom share its original's memory.)
  void copy_contacts(int from, int to, int shift);

 private:
  int rods() const;
  int id_of(int i) const;
  void move_partner(int i, int from, int to, int id);
  void turn_vectors(double *history, const spherocylinder::Quaternion &rotation) const;
};

// Brings the contact histories from the pair style's list to their rods, if they are there only.
// Before whatever changes the rods' order, adds rods, or makes LIGGGHTS's lists anew.
void bring_histories_to_rods(LAMMPS *lmp);

}  // namespace LAMMPS_NS

#endif
