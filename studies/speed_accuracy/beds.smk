# SPDX-License-Identifier: GPL-2.0-or-later
# Settled beds: poured and settled until they rest by both codes from the same poses, a job a bed,
# measured by the same programs.
from collections import Counter
from types import SimpleNamespace

from studies.common import settling
from studies.speed_accuracy import beds

BED_DECK = str(HERE / "in.bed_spheres")
BED_RUNS = str(RESULTS / "bed_runs.csv")
BED_PAGE = str(Path(README).with_name("beds.md"))


def check_bed(name, case):
    """A case of rods or of glued spheres, the numbers it has."""
    for key in case.keys() - {"rule", "lambdas", "seeds"}:
        one_number(f"{key} of {name}", case[key], 1e-6, 1 if key == "fraction" else float("inf"))
    one_whole_number(f"seeds of {name}", case["seeds"], 1)
    if case.get("rule", "spread") not in ("spread", "single"):
        refuse(f"rule of {name} must be spread or single (got {case['rule']})")
    aspects = case.get("lambdas", [10])
    if not isinstance(aspects, list):
        refuse(f"lambdas of {name} must be a list (got {aspects})")
    for aspect in aspects:
        one_number(f"lambdas of {name}", aspect, 1)


OF_RODS = ("rule", "stiffness", "fraction", "seeds")
OF_SPHERES = ("spacing", "contacts", "fraction", "seeds")
check_bed("bed_reference", mapping_of("bed_reference", OF_RODS, []))
for name, keys in (("bed_rods", OF_RODS), ("bed_spheres", OF_SPHERES)):
    for case in mappings_of(name, keys, ["lambdas"]):
        check_bed(name, case)
whole_numbers_of("bed_seeds", 1)
number_of("bed_time", 0.1)
whole_number_of("bed_number", 0)
if truth("beds_kept") and not Path(BED_RUNS).exists():
    refuse(f"beds_kept=1 takes the beds of {BED_RUNS}, which is not there")
BED_ASPECTS = [f"{value:g}" for value in numbers_of("bed_lambdas", 1)]


# Names of all beds, and how many of each case.
BED_JOBS = beds.jobs(config, BED_ASPECTS, values_of("bed_seeds"))
BEDS_PLANNED = Counter(case for _, case in BED_JOBS)


# --config beds_there=1: of the beds that have been made, and none if none has, so that a study that was
# stopped can be charted; beds_kept=1: the table of beds as it is kept.
BEDS_THERE = [path for path in (f"beds/{job}.csv" for job, _ in BED_JOBS) if (WORK / path).exists()]
if Path(BED_RUNS).exists() if KEPT or truth("beds_kept") else BEDS_THERE or not truth("beds_there"):
    BED_ROWS = str(RESULTS / "beds.csv")


wildcard_constraints:
    bed_aspect="[0-9.]+",
    bed_seed="[0-9]+",
    stiffness="[0-9.]+",
    fraction="[0-9.]+",
    rule="spread|single",


if not KEPT:

    rule bed_of_rods:
        input: settling.DECKS, PLUGIN
        output: "beds/{bed_aspect}_rods_{rule}_k{stiffness}_f{fraction}_s{bed_seed}.csv"
        run:
            w = SimpleNamespace(**wildcards)
            beds.rods(output[0], float(w.bed_aspect), int(w.bed_seed), w.rule, float(w.stiffness),
                      float(w.fraction), float(config["bed_time"]), int(config["bed_number"]), BUILD)

    rule bed_of_spheres:
        input: settling.DECKS, settling.LAW, BED_DECK
        output: "beds/{bed_aspect}_spheres_{spacing}r_c{contacts}_f{fraction}_s{bed_seed}.csv"
        run:
            w = SimpleNamespace(**wildcards)
            beds.spheres(output[0], float(w.bed_aspect), int(w.bed_seed), float(w.spacing),
                         float(w.contacts), float(w.fraction), float(config["bed_time"]),
                         int(config["bed_number"]), BED_DECK, BUILD)

    if not truth("beds_kept"):

        rule bed_runs:
            input: BEDS_THERE if truth("beds_there") else [f"beds/{job}.csv" for job, _ in BED_JOBS]
            output: BED_RUNS
            run:
                rows.collect(input, output[0], by=[*beds.CASE, "divided_by", "seed"])


if "BED_ROWS" in globals():

    rule bed_rows:
        input: BED_RUNS, str(HERE / "beds.py")
        output: BED_ROWS
        run:
            rows.write_rows(output[0], beds.charted(rows.read_rows(input[0]),
                                                    config["bed_reference"]))

    rule bed_page:
        input: BED_RUNS, BED_ROWS, template=str(HERE / "beds.md.j2"), code=str(HERE / "beds.py")
        output: BED_PAGE
        run:
            pages.render(input.template, output[0], beds.page_values(
                rows.read_rows(BED_RUNS), rows.read_rows(BED_ROWS), config["bed_reference"],
                "" if Path(README).parent == RESULTS else os.path.relpath(RESULTS, HERE) + "/",
                BEDS_PLANNED, float(config["bed_time"])))
