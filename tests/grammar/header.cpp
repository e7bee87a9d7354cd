// SPDX-License-Identifier: GPL-2.0-or-later
// The parts of a deck from atom_style to the time step, and its data file.
#include <fmt/format.h>

#include "draft.h"

namespace grammar {

namespace {

int types_in(const Draft &draft)
{
  return draft.plan.material.types + (draft.setting == Setting::UnusedType ? 1 : 0);
}

std::string pair_property(const Draft &draft, const std::string &name, double value,
                          bool by_type = false)
{
  const int types = types_in(draft);
  const Material &m = draft.plan.material;
  const auto factor = [&](int type) {
    return by_type && type < m.types ? m.stiffness_of_type[type] : 1.0;
  };
  std::string line =
      fmt::format("fix {0} all property/global {0} peratomtypepair {1}", name, types);
  for (int i = 0; i < types; i++)
    for (int j = 0; j < types; j++) line += fmt::format(" {:.17g}", value * factor(i) * factor(j));
  return line + "\n";
}

std::string type_property(const Draft &draft, const std::string &name, double value)
{
  std::string line = fmt::format("fix {0} all property/global {0} peratomtype", name);
  for (int i = 0; i < types_in(draft); i++) line += fmt::format(" {:.17g}", value);
  return line + "\n";
}

std::string properties(const Draft &draft)
{
  const Material &m = draft.plan.material;
  std::string text = pair_property(draft, "coefficientRestitution", m.restitution) +
                     pair_property(draft, "coefficientFriction", m.friction);
  if (m.normal == "linear") {
    text +=
        pair_property(draft, "kn", m.kn, true) + pair_property(draft, "kt", 2.0 / 7.0 * m.kn, true);
  } else if (m.normal == "hooke/stiffness") {
    text += pair_property(draft, "kn", m.kn) + pair_property(draft, "kt", 2.0 / 7.0 * m.kn) +
            pair_property(draft, "gamman", m.elastic() ? 0.0 : 2000.0) +
            pair_property(draft, "gammat", m.elastic() ? 0.0 : 1000.0);
  } else {
    text += type_property(draft, "youngsModulus", m.young) +
            type_property(draft, "poissonsRatio", m.poisson) +
            "fix characteristicVelocity all property/global characteristicVelocity scalar 1.0\n";
  }
  if (!m.cohesion.empty()) text += pair_property(draft, "cohesionEnergyDensity", 1e4);
  if (!m.rolling.empty()) text += pair_property(draft, "coefficientRollingFriction", 0.1);
  if (m.rolling == "epsd") text += pair_property(draft, "coefficientRollingViscousDamping", 0.2);
  return text;
}

int ranks_in(const Draft &draft)
{
  if (draft.setting != Setting::OtherRanks) return draft.plan.ranks;
  return draft.plan.ranks == 1 ? 2 : 1;
}

}  // namespace

std::string box_command(const Draft &draft)
{
  std::string bounds;
  for (int d = 0; d < 3; d++)
    bounds += fmt::format(" {:.17g} {:.17g}", draft.box.lo[d], draft.box.hi[d]);
  return fmt::format("region box block{} units box\ncreate_box {} box\n", bounds, types_in(draft));
}

std::string data_file(const Draft &draft)
{
  std::string text =
      fmt::format("rods\n\n{} atoms\n{} atom types\n\n", draft.rods.size(), types_in(draft));
  for (int d = 0; d < 3; d++)
    text +=
        fmt::format("{0:.17g} {1:.17g} {2}lo {2}hi\n", draft.box.lo[d], draft.box.hi[d], "xyz"[d]);
  std::string atoms, velocities;
  for (const auto &[id, rod] : draft.rods) {
    atoms += fmt::format("{} {} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} "
                         "{:.17g}\n",
                         id, rod.type, 2.0 * rod.radius, rod.length, rod.density, rod.x.x, rod.x.y,
                         rod.x.z, rod.axis.x, rod.axis.y, rod.axis.z);
    velocities += fmt::format("{} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}\n", id, rod.v.x,
                              rod.v.y, rod.v.z, rod.omega.x, rod.omega.y, rod.omega.z);
  }
  return text + "\nAtoms\n\n" + atoms + "\nVelocities\n\n" + velocities;
}

std::string header(const Draft &draft, const std::string &source)
{
  const bool other_skins = draft.setting == Setting::OtherSkins;
  const bool hash = draft.hash != (draft.setting == Setting::HashMap);
  const int ranks = ranks_in(draft);
  std::string text = "atom_style spherocylinder\n";
  text += fmt::format("atom_modify map {}{}\n", hash ? "hash" : "array",
                      draft.sorted ? " sort 20 0.02" : "");
  text += fmt::format("boundary {} {} {}\nnewton {}\ncommunicate single vel yes\nunits si\n",
                      draft.boundary[0], draft.boundary[1], draft.boundary[2],
                      draft.newton ? "on" : "off");
  if (ranks == 2) text += "processors 2 1 1\n";
  if (ranks == 4) text += "processors 2 2 1\n";
  text += source;
  text += fmt::format("neighbor {} bin\nneigh_modify delay 0\n",
                      other_skins ? 1.7 * draft.skin : draft.skin);
  text += properties(draft);
  text += fmt::format("pair_style gran {}{}{}{}\npair_coeff * *\n", draft.models,
                      draft.keywords + draft.sudden_overlap,
                      draft.plan.material.spread ? "" : " spread_contact off",
                      other_skins                  ? " close_skin 0.002"
                      : draft.close_skin == "auto" ? ""
                                                   : " close_skin " + draft.close_skin);
  text += draft.wall_text + draft.part_text;
  text += fmt::format("fix motion {} nve/spherocylinder\n", draft.integrated);
  text += "compute kinetic all ke\ncompute turning all erotate/spherocylinder\n"
          "compute contacts all contact/spherocylinder\n";
  text += draft.fix_text;
  if (draft.setting == Setting::Balanced)
    text += "fix spread_rods all balance 20 1.01 shift xyz 10 1.01 weight neigh 0.45\n";
  text += draft.compute_text;
  text += fmt::format("thermo_style custom step atoms{}\nthermo_modify norm no lost {} format "
                      "float %.17g\nthermo {}\ntimestep {}\n",
                      draft.thermo_columns, draft.lost, draft.unit, draft.dt);
  return text;
}

}  // namespace grammar
