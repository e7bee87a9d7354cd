# SPDX-License-Identifier: GPL-2.0-or-later
# The scenes: each is swept with both codes, two sweeps side by side, then what came out best is timed
# again, alone on the machine and in turns.
import shlex

from studies.speed_accuracy.scenes import SCENES

SWEEP = [str(HERE / name) for name in ("sweep.py", "codes.py", "scenes.py", "rods.py")]
SCENE_DECKS = {"rods": [str(HERE / "in.rods_scene")],
               "spheres": [str(HERE / "in.spheres_place"), str(HERE / "in.spheres_scene")]}
SCENE_NAMES = choices_of("scenes", list(SCENES))
SCENE_ASPECTS = [f"{value:g}" for value in numbers_of("lambdas", 1)]
SCENE_ROWS = str(RESULTS / "scenes.csv")
SCENE_COMMANDS = str(rows.commands_beside(SCENE_ROWS))


def sweep_options(code):
    """The options of sweep.py for a code that config.yaml gives."""
    number_of(f"{code}_work", 1)
    for name in ("seed", "copies", "spheres"):
        whole_number_of(name, 1)
    words = ["--code", code, "--build", BUILD, "--seed", config["seed"], "--copies", config["copies"],
             "--spheres", config["spheres"], "--most-work", config[f"{code}_work"]]
    for option, name in (("--spacings", "spacings"), ("--stiffnesses", f"{code}_stiffnesses"),
                         ("--fractions", f"{code}_fractions")):
        numbers_of(name, 1e-6, *([1] if option == "--fractions" else []))
        words += [option, *values_of(name)]
    return shlex.join(map(str, words))


wildcard_constraints:
    scene="[a-z_]+",
    aspect="[0-9.]+",
    code="rods|spheres",


whole_number_of("turns", 1)
for code in SCENE_DECKS:
    sweep_options(code)
need_kept(SCENE_ROWS, SCENE_COMMANDS)


if not KEPT:
    need_programs("lmp", "rods_to_multisphere", "multisphere_to_rods", "rod_packing",
                  "rod_orientation")

    rule scene_sweep:
        input:
            SWEEP,
            lambda wildcards: SCENE_DECKS[wildcards.code],
            PLUGIN,
        output: "scenes/{scene}_{aspect}_{code}.csv"
        log: "logs/scene_{scene}_{aspect}_{code}.log"
        params:
            options=lambda wildcards: sweep_options(wildcards.code),
        shell:
            "/usr/bin/python3 {HERE}/sweep.py run {wildcards.scene} {wildcards.aspect} {params.options} "
            "--work scenes/{wildcards.scene}_{wildcards.aspect}_{wildcards.code} --out {output} "
            ">{log} 2>&1"

    rule scene_timing:
        input:
            rows=["scenes/kept.csv"] if truth("scenes_kept") else
                 ["scenes/{scene}_{aspect}_rods.csv", "scenes/{scene}_{aspect}_spheres.csv"],
        output: "scenes/{scene}_{aspect}_timed.csv"
        log: "logs/scene_{scene}_{aspect}_timed.log"
        threads: workflow.cores
        resources: timing=1
        params:
            options=lambda wildcards: sweep_options("rods"),
        shell:
            "/usr/bin/python3 {HERE}/sweep.py time {wildcards.scene} {wildcards.aspect} {input.rows} "
            "{params.options} --turns {config[turns]} "
            "--work scenes/{wildcards.scene}_{wildcards.aspect}_timed --out {output} >{log} 2>&1"

    # --config scenes_kept=1: a copy, since the table itself is made anew at the end.
    rule kept_scenes:
        output: "scenes/kept.csv"
        run: rows.write_rows(output[0], rows.read_rows(SCENE_ROWS))

    rule scene_rows:
        input:
            expand("scenes/{scene}_{aspect}_timed.csv", scene=SCENE_NAMES, aspect=SCENE_ASPECTS),
        output: SCENE_ROWS, SCENE_COMMANDS
        run:
            rows.write_rows_and_commands(output[0], rows.together(input))
