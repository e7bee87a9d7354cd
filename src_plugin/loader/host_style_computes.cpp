// SPDX-License-Identifier: GPL-2.0-or-later
#include "loader/host_style_rows.h"

namespace spherocylinder {

namespace {

constexpr HostStyle right(const char *name, const char *sentence = "")
{
  return {HostKind::Compute, name, Verdict::Right, sentence};
}

constexpr HostStyle different(const char *name, const char *sentence)
{
  return {HostKind::Compute, name, Verdict::Different, sentence};
}

constexpr HostStyle of_centres(const char *name)
{
  return {
      HostKind::Compute, name, Verdict::Different,
      "of the rods' centres, whose distances say nothing about contact; on several ranks all ghosts "
      "are sent in each step",
      true};
}

constexpr HostStyle refused(const char *name, const char *sentence)
{
  return {HostKind::Compute, name, Verdict::Refused, sentence};
}

constexpr const char *kPoints = "of the rods' centres, as of points";
constexpr const char *kMolecules =
    "atom_style spherocylinder has no molecules; use groups and compute reduce";
constexpr const char *kMultisphere = "it is for spheres joined to bodies; leave it out";

}  // namespace

std::vector<HostStyle> compute_rows()
{
  return {
      refused("atom/molecule", kMolecules),
      refused("bond/local", "atom_style spherocylinder has no bonds; use compute pair/gran/local"),
      of_centres("centro/atom"),
      of_centres("cluster/atom"),
      of_centres("cna/atom"),
      right("com"),
      refused("com/molecule", kMolecules),
      refused("contact/atom",
              "it would count the rods' bounding spheres; use compute contact/spherocylinder"),
      refused("contact/atom/gran",
              "it would count the rods' bounding spheres; use compute contact/spherocylinder"),
      of_centres("coord/atom"),
      right("displace/atom"),
      refused("erotate", "it takes rods for spheres; use compute erotate/spherocylinder"),
      refused("erotate/asphere", "it is for ellipsoids; use compute erotate/spherocylinder"),
      refused("erotate/multisphere", "it is for spheres joined to bodies; use compute "
                                     "erotate/spherocylinder"),
      refused("erotate/sphere",
              "it takes a rod's inertia for a sphere's; use compute erotate/spherocylinder"),
      refused("erotate/sphere/atom",
              "it takes a rod's inertia for a sphere's; use compute erotate/spherocylinder"),
      refused("group/group", "granular contacts have no energy or force between a pair to ask for; "
                             "use compute pair/gran/local"),
      different("gyration", kPoints),
      refused("gyration/molecule", kMolecules),
      refused("inertia/molecule", kMolecules),
      different("ke", "of the centres' motion; of spin: compute erotate/spherocylinder"),
      different("ke/atom", "of the centres' motion; of spin: compute erotate/spherocylinder"),
      refused("ke/multisphere", kMultisphere),
      right("msd"),
      refused("msd/molecule", kMolecules),
      refused("multisphere", kMultisphere),
      refused("multisphere/single", kMultisphere),
      different("nparticles/tracer/region", "a rod is in the region if its centre is"),
      right("pair/gran/local", "contact points, normals and overlaps of rods: see its page"),
      different("pe", "granular contacts have no potential energy: 0"),
      different("pe/atom", "granular contacts have no potential energy: 0"),
      different("pressure", "the contacts' forces times the distance of centres; ke: the centres' "
                            "motion"),
      different("property/atom",
                "also axis (ux uy uz), quaternion and length; diameter and volume are "
                "the rod's own; radius is the bounding radius, half its length"),
      refused("property/local",
              "granular pair styles do not serve it; use compute pair/gran/local"),
      refused("property/molecule", kMolecules),
      of_centres("rdf"),
      right("reduce"),
      right("reduce/region", "a rod is in the region if its centre is"),
      refused("reduce/sph", "it is for smoothed-particle fluids; use compute reduce"),
      refused("rigid", kMultisphere),
      right("slice"),
      different("stress/atom",
                "half of each contact's force times the distance of centres; ke: the "
                "centre's motion"),
      different("temp", "of the centres' motion"),
      right("wall/gran/local", "contact points and overlaps of rods' ends: see its page"),
  };
}

}  // namespace spherocylinder
