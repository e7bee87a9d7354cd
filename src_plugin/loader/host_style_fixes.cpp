// SPDX-License-Identifier: GPL-2.0-or-later
#include "loader/host_style_rows.h"

namespace spherocylinder {

namespace {

constexpr HostStyle right(const char *name, const char *sentence = "")
{
  return {HostKind::Fix, name, Verdict::Right, sentence};
}

constexpr HostStyle different(const char *name, const char *sentence)
{
  return {HostKind::Fix, name, Verdict::Different, sentence};
}

constexpr HostStyle refused(const char *name, const char *sentence)
{
  return {HostKind::Fix, name, Verdict::Refused, sentence};
}

constexpr const char *kNoTurn = "it does not turn the rods' axes; use fix nve/spherocylinder";
constexpr const char *kCoupling =
    "it hands over the bounding sphere's radius as the particle's, not one of equal volume; use "
    "fix buoyancy and fix viscous for a still fluid";
constexpr const char *kSph =
    "it is for smoothed-particle fluids and has no meaning for rods; leave it out";
constexpr const char *kMultisphere = "it joins spheres to bodies; use rods of the wanted length";
constexpr const char *kTemplate =
    "it makes spheres; use fix particletemplate/spherocylinder (a sphere is a rod with length = "
    "diameter)";
constexpr const char *kCentre = "the force acts on the rod's centre and makes no torque";
constexpr const char *kInternal = "made by LIGGGHTS itself";

}  // namespace

std::vector<HostStyle> fix_rows()
{
  return {
      refused("adapt", "it changes the bounding sphere's diameter and not the rod; change rods "
                       "between runs by set ... diameter D length L"),
      right("addforce", kCentre),
      right("ave/atom"),
      right("ave/correlate"),
      refused("ave/euler",
              "it takes a rod's volume for its bounding sphere's; use fix ave/spatial with "
              "density/mass over the rods' density"),
      refused("ave/euler/stress",
              "it takes a rod's volume for its bounding sphere's; use compute stress/atom and fix "
              "ave/spatial"),
      right("ave/histo"),
      different("ave/spatial", "a rod counts in the bin of its centre, with its whole mass"),
      right("ave/time"),
      right("aveforce", kCentre),
      refused("box/relax", "it needs an energy minimiser, which rods have not; use fix deform"),
      right("buoyancy", "of the part of the rod that is immersed, at its centroid"),
      refused("check/timestep/gran",
              "it takes Rayleigh and Hertz times from the bounding sphere; use fix "
              "check/timestep/spherocylinder"),
      refused("check/timestep/sph", kSph),
      refused("concave", kMultisphere),
      right("contacthistory", kInternal),
      right("contacthistory/mesh", kInternal),
      right("contactproperty/atom", kInternal),
      right("contactproperty/atom/wall", kInternal),
      refused("continuum/weighted", "rods' contacts store no forces for it; use compute "
                                    "pair/gran/local or compute stress/atom"),
      refused("couple/cfd", kCoupling),
      refused("couple/cfd/convection", kCoupling),
      refused("couple/cfd/convectiveImpl", kCoupling),
      refused("couple/cfd/dragforce", kCoupling),
      refused("couple/cfd/force", kCoupling),
      refused("couple/cfd/force/implicit", kCoupling),
      refused("couple/cfd/radiation", kCoupling),
      refused("couple/cfd/speciesConvection", kCoupling),
      refused("couple/lb/onetoone", kCoupling),
      right("custom_property/global"),
      different("deform",
                "the rods' centres move with the box, their axes and sizes do not change; "
                "no tilt (xy, xz, yz)"),
      different("deform/check", "as fix deform"),
      right("diam/max", "the longest rod of the particle distributions"),
      right("drag", kCentre),
      refused("dt/reset",
              "it looks at the speed of a rod's centre and not of its ends; use a fixed "
              "timestep and fix check/timestep/spherocylinder"),
      refused("efield", "atom_style spherocylinder has no charge; use fix addforce"),
      refused("enforce2d", "a rod in a plane would need its axis kept there; use dimension 3"),
      right("external", kCentre),
      refused("fiber/spring/simple",
              "it joins the centres of bounding spheres; use rods of the wanted length"),
      right("freeze", "the rods stand still: no force, no torque, no velocity, no spin"),
      right("gravity"),
      right("heat/gran", "conducts where rods touch; see its page"),
      right("heat/gran/conduction", "conducts where rods touch; see its page"),
      right("insert/pack", "with fix particletemplate/spherocylinder"),
      right("insert/rate/region", "with fix particletemplate/spherocylinder"),
      right("insert/stream", "with fix particletemplate/spherocylinder"),
      right("lineforce", "of the centre's force"),
      different("massflow/mesh",
                "a rod counts when its centre passes; the diameter in its file is the "
                "rod's length"),
      refused("massflow/mesh/sieve",
              "it decides by the bounding sphere's diameter what passes; use fix massflow/mesh"),
      right("mesh/surface", "as a wall of fix wall/gran, a face for insertion or counting"),
      right(
          "mesh/surface/planar",
          "as a face for insertion or counting; refused as a wall, for which there is mesh/surface"),
      different("momentum",
                "linear: right; angular: that of the centres' motion only, the rods' own "
                "spin is left as it is, as with spheres"),
      right("move",
            "axes turn with the motion; a rod that is driven in all directions does not give "
            "way"),
      right("move/mesh"),
      right("move/mesh/file"),
      right("move/mesh/gran"),
      refused("multicontact/halfspace",
              "it corrects overlaps of spheres by their radius; use surface spherocylinder alone"),
      refused("multisphere", kMultisphere),
      refused("multisphere/break", kMultisphere),
      refused("multisphere/nointegration", kMultisphere),
      right("neighlist/mesh", kInternal),
      refused("nve", kNoTurn),
      refused("nve/asphere", "it turns ellipsoids by another inertia; use fix nve/spherocylinder"),
      refused("nve/asphere/noforce", kNoTurn),
      refused("nve/limit", kNoTurn),
      refused("nve/line", "it is for line segments; use fix nve/spherocylinder"),
      refused("nve/noforce", kNoTurn),
      refused("nve/sph", kSph),
      refused("nve/sph/stationary", kSph),
      refused("nve/sphere", "it turns a sphere of the rod's length; use fix nve/spherocylinder"),
      right("particledistribution/discrete"),
      right("particledistribution/discrete/massbased"),
      right("particledistribution/discrete/numberbased"),
      refused("particletemplate/multiplespheres", kTemplate),
      refused("particletemplate/multisphere", kTemplate),
      refused("particletemplate/sphere", kTemplate),
      right("planeforce", "of the centre's force"),
      right("print"),
      right("property/atom"),
      different("property/atom/regiontracer/time", "a rod is in the region if its centre is"),
      different("property/atom/timetracer", "a rod is in the region if its centre is"),
      different("property/atom/tracer", "a rod is in the region if its centre is"),
      right("property/atom/tracer/stream"),
      right("property/atomtype"),
      right("property/atomtypepair"),
      right("property/global"),
      right("region/variable"),
      refused("rigid",
              "it carries the rods' centres round and does not turn their axes; use fix move for "
              "driven bodies, rods of the wanted length for free ones"),
      right("setforce", "of the centre's force; torques stay"),
      refused("sph/density/continuity", kSph),
      refused("sph/density/corr", kSph),
      refused("sph/density/summation", kSph),
      refused("sph/pressure", kSph),
      right("spring", kCentre),
      refused("spring/rg", "it asks for masses by type, which rods have not (LIGGGHTS ends in a "
                           "segmentation fault); use fix spring or fix spring/self"),
      right("spring/self", kCentre),
      right("store/force"),
      right("store/state"),
      right("transportequation/scalar", "made by fix heat/gran"),
      different("viscous", "a drag on the centre's velocity by the coefficient given; spin is not "
                           "slowed"),
      right("wall/gran", "with surface spherocylinder; see its page for the walls there are"),
      refused("wall/region", "it pushes bounding spheres; use fix wall/gran"),
      refused("wall/region/sph", kSph),
      refused("wall/sph", kSph),
      refused("MINIMIZE", "rods have no energy minimiser; let them settle with fix "
                          "nve/spherocylinder"),
      right("READ_RESTART", kInternal),
      refused("RESPA", "rods are integrated with one time step; use run_style verlet"),
      right("STORE", kInternal),
  };
}

}  // namespace spherocylinder
