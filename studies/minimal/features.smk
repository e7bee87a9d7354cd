# SPDX-License-Identifier: GPL-2.0-or-later
# What each feature of a scene costs: a job a scene counts, another times it alone on the machine.
FEATURES = str(RESULTS / "features.csv")
FEATURE_SCENES = list(mapping_of("features"))
FEATURE_SIZES = dict(number=whole_number_of("feature_particles", 1),
                     seed=whole_number_of("feature_seed", 1), build=BUILD)


wildcard_constraints:
    scene="[a-z]+",


for name in ("feature_start_steps", "feature_counted_steps", "feature_timed_steps", "feature_turns"):
    whole_number_of(name, 1)
if not FEATURE_SCENES:
    refuse("features must not be empty")
for name, changes in config["features"].items():
    if name not in features.SCENES:
        refuse(f"features must be of {', '.join(features.SCENES)} (got {name})")
    if not isinstance(changes, list) or changes[:1] != [features.FIRST]:
        refuse(f"features of {name} must be a list that begins with {features.FIRST} (got {changes})")
    for change in changes:
        if change not in features.CHANGES:
            refuse(f"features of {name} must be among {', '.join(features.CHANGES)} (got {change})")
need_kept(FEATURES)


if not KEPT:

    rule feature_counts:
        input: features.DECK, PLUGIN, str(HERE / "features.py")
        output: "counted/{scene}.csv"
        run:
            features.count(output[0], wildcards.scene, config["features"][wildcards.scene],
                           start_steps=int(config["feature_start_steps"]),
                           counted_steps=int(config["feature_counted_steps"]), **FEATURE_SIZES)

    rule feature_times:
        input: "counted/{scene}.csv"
        output: "timed_features/{scene}.csv"
        threads: workflow.cores
        resources: timing=1
        run:
            features.time(output[0], wildcards.scene, config["features"][wildcards.scene],
                          Path(input[0]).with_suffix(""), steps=int(config["feature_timed_steps"]),
                          turns=int(config["feature_turns"]), **FEATURE_SIZES)

    rule feature_table:
        input:
            counted=wanted(expand("counted/{scene}.csv", scene=FEATURE_SCENES)),
            timed=wanted(expand("timed_features/{scene}.csv", scene=FEATURE_SCENES))
        output: FEATURES
        run:
            counted, timed = ([rows.read_rows(path) for path in paths]
                              for paths in (input.counted, input.timed))
            rows.write_rows(output[0], features.together(counted, timed))
