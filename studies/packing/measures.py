# SPDX-License-Identifier: GPL-2.0-or-later
"""What the figures, tables and the page tell: means over beds, and theory beside them."""
from __future__ import annotations

from math import e, isnan, nan, pi, sqrt
from pathlib import Path

import numpy
import pandas

from studies.common import rows, settling, statistics

KIND = ["lambda", "friction", "limits"]
SAME_BED = [*KIND, "seed"]
STUDY_FRICTION = 0.2
FROM_0_TO_1 = ("vf_whole", "vf_inner", "mean_sin_gamma")

# <|sin gamma|> over pairs of axes, gamma the angle between them: isotropic, and at random in a plane.
ISOTROPIC_SIN_GAMMA = pi / 4
HORIZONTAL_SIN_GAMMA = 2 / pi
# Half the mean number of contacts of a rod: 5.25 ± 0.03 measured for poured rods (Desmond and Franklin,
# Phys. Rev. E 73 (2006) 031306).
HALF_CONTACTS = 5.25
# 2 ln λ/λ has its maximum at e; random contacts are for long rods.
PARKHOUSE_KELLY_FROM = e
RANDOM_CONTACTS_FROM = 5.0
# ∫ of the elevation over the sphere: π/2 - 1 rad; S = <P2> of the vertical for horizontal axes.
ISOTROPIC_ELEVATION_DEG = (pi / 2 - 1) * 180 / pi
HORIZONTAL_ORDER = -0.5

# What the study's words are taken to mean here. V_f "slightly lower than the theory": by at most SLIGHTLY,
# and not above it; its two measures of V_f "close": the whole vessel's at most CLOSE below the inner one's;
# "most" rods "near horizontal": more than MOST of them lower than the elevation below which a third of
# isotropic rods are; "stable": the kinetic energy left is that of a bed at rest by the decks' own measure.
SLIGHTLY = 0.1
CLOSE = 0.1
MOST = 0.5
NEAR_HORIZONTAL_DEG = numpy.degrees(numpy.arcsin(1 / 3))


def parkhouse_kelly(aspect):
    """2 ln λ/λ (Parkhouse and Kelly, Proc. R. Soc. Lond. A 451 (1995) 737)."""
    return 2 * numpy.log(aspect) / aspect


def random_contacts(aspect, sin_gamma):
    """V_f = 2 c V_p/V_ex (Philipse, Langmuir 12 (1996) 1127) for capsules with a cylinder of
    x = λ - 1 diameters: V_p = x/4 + 1/6, V_ex = (2 s/π) x² + 2 x + 4/3, in units of π D³."""
    x = aspect - 1.0
    return 2 * HALF_CONTACTS * (x / 4 + 1 / 6) / ((2 * sin_gamma / pi) * x * x + 2 * x + 4 / 3)


def densest(aspect):
    """The densest known packing of equal capsules, all parallel: hexagonal layers of touching
    cylinders whose round ends fit into each other as in a close packing of spheres."""
    x = aspect - 1.0
    return pi / sqrt(12) * (x + 2 / 3) / (x + sqrt(2 / 3))


def expected(aspect, sin_gamma) -> float:
    """Random contacts, NaN for short rods and where it exceeds what space there is: contacts of nearly
    parallel rods are not random."""
    fraction = random_contacts(aspect, sin_gamma)
    return fraction if aspect >= RANDOM_CONTACTS_FROM and fraction <= densest(aspect) else nan


def read_beds(path: Path | str) -> pandas.DataFrame:
    """beds.csv, or a sentence on what cannot be right in it."""
    beds = rows.read_rows(path).sort_values(SAME_BED, kind="stable", ignore_index=True)
    twice = beds[beds.duplicated(SAME_BED)]
    if len(twice):
        raise ValueError(f"{path}: two rows for one bed: {dict(twice.iloc[0][SAME_BED])}")
    for name in FROM_0_TO_1:
        wrong = beds[~beds[name].between(0, 1)]
        if len(wrong):
            raise ValueError(f"{path}: {name} is {wrong.iloc[0][name]}, wanted from 0 to 1")
    return beds


def collect(paths, former: str | None, out: Path | str) -> None:
    """The rows of many files in one, after those of the file `former`, if given, of other kinds."""
    table = pandas.concat([rows.read_rows(path) for path in paths], ignore_index=True)
    if former:
        kept = rows.read_rows(former)
        made = set(zip(*(table[name] for name in KIND)))
        others = [kind not in made for kind in zip(*(kept[name] for name in KIND))]
        table = pandas.concat([kept[others], table], ignore_index=True)
    rows.write_rows(out, table.sort_values(SAME_BED, kind="stable", ignore_index=True))


def packing_means(beds: pandas.DataFrame) -> pandas.DataFrame:
    """A row for each λ, friction and limits: `beds`, their number, and for each measure its mean and, as
    NAME_error, the standard error; largest overlap and energy as the largest of all beds."""
    result = []
    for (aspect, friction, limits), kind in beds.groupby(KIND):
        row = {"lambda": aspect, "friction": friction, "limits": limits, "beds": len(kind), "rods": int(kind["rods"].sum())}
        for name in ("vf_inner", "vf_whole", "vf_random_contacts", "mean_elevation_deg",
                     "mean_sin_gamma", "nematic_order", "contacts_per_rod",
                     "mean_overlap_over_diameter"):
            row[name], row[f"{name}_error"] = statistics.mean_and_error(kind[name])
        row["vf_theory"] = kind["vf_theory"].mean()
        for name in ("largest_overlap_over_diameter", "momentary_overlap_over_diameter", "energy_J"):
            row[name] = kind[name].max()
        # At the mean orientation of the beds.
        row["vf_expected"] = expected(aspect, row["mean_sin_gamma"])
        result.append(row)
    return pandas.DataFrame(result)


def elevation_means(elevation: pandas.DataFrame) -> pandas.DataFrame:
    """A row for each λ, friction, limits and bin: mean density, its error over the beds (of a single bed that of
    its counts), scatter of the density of as many isotropic rods, and their number. Raises ValueError
    unless all beds of a kind have the same bins, each once."""
    result = []
    for (aspect, friction, limits), kind in elevation.groupby(KIND):
        beds = kind["seed"].nunique()
        for (low, high), of_bin in kind.groupby(["elevation_low_deg", "elevation_high_deg"]):
            if len(of_bin) != beds or of_bin["seed"].nunique() != beds:
                raise ValueError(f"lambda {aspect}, friction {friction:g}, limits {limits}: the bin from {low:.4g} to "
                                 f"{high:.4g} degrees has {len(of_bin)} rows for {beds} beds")
            density, error = statistics.mean_and_error(of_bin["density"])
            one = of_bin.iloc[0]
            scatter = one["isotropic_scatter"] / one["isotropic_fraction"]
            part = one["isotropic_fraction"]
            result.append({
                "lambda": aspect, "friction": friction, "limits": limits, "beds": beds, "low_deg": low, "high_deg": high,
                "density": density, "error": one["density_error"] if isnan(error) else error,
                "isotropic_scatter": scatter / sqrt(beds),
                # A part q of n isotropic rods scatters by sqrt(q (1 - q)/n), in units of q by s.
                "isotropic_rods": beds * (1 - part) / (part * scatter * scatter)})
    return pandas.DataFrame(result)


def verdicts(beds: pandas.DataFrame, means: pandas.DataFrame,
             elevation: pandas.DataFrame) -> pandas.DataFrame:
    """A row for each λ, friction and limits: what the study states, in numbers, and whether it holds.
    `below`: of theory, part of it; `apart`: inner and whole V_f, part of the first; `level`: part of the
    rods near the horizontal; `moving`: kinetic energy of a rod over m g D, the most of any bed."""
    low = elevation[elevation["elevation_high_deg"] < NEAR_HORIZONTAL_DEG + 1e-3]
    level = low.groupby(SAME_BED)["fraction"].sum().groupby(KIND).mean()
    table = means[KIND].copy()
    table["below"] = 1 - means["vf_inner"] / means["vf_theory"]
    table["apart"] = 1 - means["vf_whole"] / means["vf_inner"]
    table["level"] = [level[tuple(kind)] for kind in table[KIND].itertuples(index=False)]
    weight = [settling.GRAVITY * settling.DIAMETER * settling.mass_of(a) for a in beds["lambda"]]
    moving = (beds["energy_J"] / beds["rods"] / weight).groupby([beds[name] for name in KIND]).max()
    table["moving"] = [moving[tuple(kind)] for kind in table[KIND].itertuples(index=False)]
    return table.assign(
        stable=table["moving"] <= settling.REST_ENERGY, flat=table["level"] > MOST,
        close=table["apart"].abs() <= CLOSE, slightly=table["below"].between(0, SLIGHTLY))


def read_literature(path: Path | str) -> pandas.DataFrame:
    """literature.csv: lambda, vf, vf_error (may be empty), kind, label, source."""
    table = rows.read_rows(path)
    wrong = table[(table["lambda"] < 1) | ~table["vf"].between(0, 1) | (table["vf_error"] < 0)]
    if len(wrong):
        raise ValueError(f"{path}: {wrong.iloc[0]['label']}: wanted lambda >= 1, vf from 0 to 1 and "
                         f"vf_error >= 0")
    return table
