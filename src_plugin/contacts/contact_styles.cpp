// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/contact_styles.h"

#include "contacts/contact_model_headers.h"
#include "contacts/granular_pair_spherocylinder.h"
#include "contacts/granular_wall_spherocylinder.h"
#include "contacts/stock_law_of.h"
#include "fix_wall_gran.h"
#include "host/rod_error.h"
#include "pair_gran.h"
#include "utils.h"

using namespace LIGGGHTS;
using namespace LIGGGHTS::ContactModels;
using LAMMPS_NS::FixWallGran;
using LAMMPS_NS::LAMMPS;
using LAMMPS_NS::PairGran;

namespace {

constexpr const char *kStyle = "gran";

template <typename Model>
PairStyles::IGranularPairStyle *create_pair(LAMMPS *lmp, PairGran *parent, int64_t hash)
{
  return new LAMMPS_NS::GranularPairSpherocylinder(
      lmp, parent, std::make_unique<LAMMPS_NS::StockLawOf<Model>>(lmp, parent, false, hash));
}

template <typename Model>
Walls::IGranularWall *create_wall(LAMMPS *lmp, FixWallGran *parent, int64_t hash)
{
  return new LAMMPS_NS::GranularWallSpherocylinder(
      lmp, parent, std::make_unique<LAMMPS_NS::StockLawOf<Model>>(lmp, parent, true, hash));
}

// Combinations compiled as one piece: what decks with rods use most.
template <int NORMAL, int TANGENTIAL>
void add_fast(std::set<int64_t> &registered)
{
  using Style = GranStyle<NORMAL, TANGENTIAL, COHESION_OFF, ROLLING_OFF, SURFACE_SPHEROCYLINDER>;
  using Model = ContactModel<Style>;
  const int64_t hash = Style::HASHCODE;
  PairStyles::Factory::instance().addStyle(kStyle, hash, &create_pair<Model>);
  Walls::Factory::instance().addStyle(kStyle, hash, &create_wall<Model>);
  registered.insert(hash);
}

template <int NORMAL>
void add_fast_tangential(std::set<int64_t> &registered)
{
  add_fast<NORMAL, TANGENTIAL_OFF>(registered);
  add_fast<NORMAL, TANGENTIAL_NO_HISTORY>(registered);
  add_fast<NORMAL, TANGENTIAL_HISTORY>(registered);
}

// These act across a gap or keep per-particle liquid: a rod's closest points do not feed them.
bool is_capillary(int cohesion)
{
  return cohesion == COHESION_EASO_CAPILLARY_VISCOUS ||
         cohesion == COHESION_WASHINO_CAPILLARY_VISCOUS;
}

[[noreturn]] void refuse_linear(LAMMPS *lmp)
{
  LAMMPS_NS::rod_error_all(lmp,
                           "Model linear is for rods: it must be given surface spherocylinder "
                           "(got another surface or none; spheres have model hooke/stiffness)");
}

PairStyles::IGranularPairStyle *refuse_linear_pair(LAMMPS *lmp, PairGran *, int64_t)
{
  refuse_linear(lmp);
}
Walls::IGranularWall *refuse_linear_wall(LAMMPS *lmp, FixWallGran *, int64_t)
{
  refuse_linear(lmp);
}

[[noreturn]] void refuse_capillary(LAMMPS *lmp)
{
  LAMMPS_NS::rod_error_all(lmp,
                           "Surface spherocylinder cannot be used with a capillary cohesion model "
                           "(expected cohesion off, sjkr or sjkr2)");
}

PairStyles::IGranularPairStyle *refuse_capillary_pair(LAMMPS *lmp, PairGran *, int64_t)
{
  refuse_capillary(lmp);
}
Walls::IGranularWall *refuse_capillary_wall(LAMMPS *lmp, FixWallGran *, int64_t)
{
  refuse_capillary(lmp);
}

// Every other combination, by LIGGGHTS's run-time dispatched model.
void add_general(const std::set<int64_t> &registered)
{
  using Model = ContactModel<GranStyle<>>;
#define SURFACE_MODEL(identifier, name, id) id,
#define NORMAL_MODEL(identifier, name, id) id,
#define TANGENTIAL_MODEL(identifier, name, id) id,
#define COHESION_MODEL(identifier, name, id) id,
#define ROLLING_MODEL(identifier, name, id) id,
  const int surfaces[] = {
#include "style_surface_model.h"
  };
  const int normals[] = {
#include "style_normal_model.h"
  };
  const int tangentials[] = {
      TANGENTIAL_OFF,
#include "style_tangential_model.h"
  };
  const int cohesions[] = {
      COHESION_OFF,
#include "style_cohesion_model.h"
  };
  const int rollings[] = {
      ROLLING_OFF,
#include "style_rolling_model.h"
  };
#undef SURFACE_MODEL
#undef NORMAL_MODEL
#undef TANGENTIAL_MODEL
#undef COHESION_MODEL
#undef ROLLING_MODEL

  auto &pairs = PairStyles::Factory::instance();
  auto &walls = Walls::Factory::instance();
  const auto for_each_minor = [&](int normal, int surface, auto &&action) {
    for (const int tangential : tangentials)
      for (const int cohesion : cohesions)
        for (const int rolling : rollings)
          action(Utils::generate_gran_hashcode(normal, tangential, cohesion, rolling, surface),
                 cohesion);
  };

  for (const int normal : normals)
    for_each_minor(normal, SURFACE_SPHEROCYLINDER, [&](int64_t hash, int cohesion) {
      if (registered.count(hash)) return;
      const bool refused = is_capillary(cohesion);
      pairs.addStyle(kStyle, hash, refused ? &refuse_capillary_pair : &create_pair<Model>);
      walls.addStyle(kStyle, hash, refused ? &refuse_capillary_wall : &create_wall<Model>);
    });
  for (const int surface : surfaces) {
    if (surface == SURFACE_SPHEROCYLINDER) continue;
    for_each_minor(NORMAL_LINEAR, surface, [&](int64_t hash, int) {
      pairs.addStyle(kStyle, hash, &refuse_linear_pair);
      walls.addStyle(kStyle, hash, &refuse_linear_wall);
    });
  }
}

}  // namespace

void LAMMPS_NS::register_contact_styles()
{
  static bool done = false;
  if (done) return;
  done = true;

  Factory::instance().addSurfaceModel("spherocylinder", SURFACE_SPHEROCYLINDER);
  Factory::instance().addNormalModel("linear", NORMAL_LINEAR);

  std::set<int64_t> registered;
  add_fast_tangential<NORMAL_LINEAR>(registered);
  add_fast_tangential<HOOKE>(registered);
  add_fast_tangential<HOOKE_STIFFNESS>(registered);
  add_fast_tangential<HERTZ>(registered);
  add_general(registered);
}
