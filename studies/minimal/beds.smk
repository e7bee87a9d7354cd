# SPDX-License-Identifier: GPL-2.0-or-later
# Beds by the decks' default and by quick 1, a job a bed.
FRESH_RUNS = str(RESULTS / "fresh_beds.csv")
EQUIVALENCE = str(RESULTS / "equivalence.csv")
SECONDS = str(RESULTS / "seconds.csv")      # timed alone
BED_LIMITS = choices_of("limits", ["study", "none"])


wildcard_constraints:
    aspect="[0-9.]+",
    seed="[0-9]+",
    way="today|quick",
    limits="study|none",


for name, least in (("number", 0), ("bed_turns", 1), ("rest_steps", 1)):
    whole_number_of(name, least)
whole_numbers_of("fresh_seeds", 1)
need_kept(FRESH_RUNS, SECONDS)


if not KEPT:
    need_programs("lmp", "rod_packing", "rod_orientation")

    rule bed:
        input: settling.DECKS, PLUGIN
        output: "beds/{aspect}_{limits}_{way}_s{seed}.csv"
        run:
            w = SimpleNamespace(**wildcards)
            advice.bed(output[0], float(w.aspect), int(w.seed), w.way, w.limits,
                       int(config["number"]), BUILD)

    rule fresh_runs:
        input:
            wanted(expand("beds/{aspect}_{limits}_{way}_s{seed}.csv", aspect=ASPECTS,
                          seed=values_of("fresh_seeds"), limits=BED_LIMITS, way=["today", "quick"]))
        output: FRESH_RUNS
        run: rows.collect(input, output[0], by=["limits", "lambda", "way", "seed"])

    # From the first rod placed to the end, the decks' default to 10 s beside quick 1, in turns.
    rule seconds:
        input: settling.DECKS, str(advice.REST_DECK), PLUGIN
        output: "timed/{aspect}.csv"
        threads: workflow.cores
        resources: timing=1
        run:
            advice.seconds(output[0], float(wildcards.aspect), int(values_of("fresh_seeds")[0]),
                           BED_LIMITS, int(config["bed_turns"]), int(config["number"]),
                           int(config["rest_steps"]), BUILD)

    rule all_seconds:
        input: wanted(expand("timed/{aspect}.csv", aspect=ASPECTS))
        output: SECONDS
        run:
            if input:
                rows.collect(input, output[0])
            else:
                Path(output[0]).write_text("lambda,limits,way\n")


rule equivalence:
    input: FRESH_RUNS
    output: EQUIVALENCE
    run:
        rows.write_rows(output[0], advice.equivalences(rows.read_rows(input[0]),
                                                       BOUND))
