# SPDX-License-Identifier: GPL-2.0-or-later
# What all studies share; the first line of each Snakefile includes it. It gives
#   ROOT, HERE     the project's folder and the study's
#   STUDY          the study's name, that of its folder
#   MODE           full, quick or smoke (the tests')
#   KEPT           figures and pages from the kept CSV files alone: define no rule that makes those
#   BUILD          folder of the programs
#   RESULTS        folder of CSV, figures and pages; README is the page beside or in it
#   PLUGIN, TOOLS  stamps of the sources of the plug-in and of the post-processors, as inputs of
#                  rules that run or measure
#   config         config.yaml with the values of its section `modes: quick:` or `modes: smoke:` in
#                  such a run; what is given by --config wins
# and refuse(sentence), need_programs(names), need_kept(tables), stamp(name, sources) for other stamps,
# figure_files(stem), what plots.save writes; of what config holds values_of, number_of, whole_number_of,
# numbers_of, whole_numbers_of, choices_of, mapping_of, mappings_of(name, ...), which refuse what a study
# cannot use. The working folder, to which relative paths belong, is the study's of this mode in
# build/studies, also that of snakemake's own records.
import os
import sys
from pathlib import Path

import yaml
from snakemake.exceptions import WorkflowError

HERE = Path(workflow.basedir).resolve()
ROOT = Path(workflow.current_basedir.get_path_or_uri()).resolve().parents[1]
sys.path[:0] = [str(ROOT)]

from studies.common import cases as _cases, plots as _plots, rows as _rows  # noqa: E402


def refuse(sentence):
    sys.tracebacklimit = 0   # where in a Snakefile it is refused is of no use to who reads it
    raise WorkflowError(f"{STUDY}: {sentence}")


def truth(name):
    value = str(config.get(name, 0)).lower()
    if value not in ("0", "1", "true", "false"):
        refuse(f"{name} must be 0 or 1 (got '{value}')")
    return value in ("1", "true")


def values_of(name):
    """A list of config.yaml, or given as [10,20] or 10 on the command line."""
    given = config[name]
    given = given if isinstance(given, list) else [given]
    if not given:
        refuse(f"{name} must not be empty")
    return [str(value) for value in given]


def one_number(name, given, low, high=float("inf"), kind="number"):
    try:
        value = float(given)
    except (TypeError, ValueError):
        value = float("nan")
    whole = kind == "number" or str(given).isdecimal()
    if not (low <= value <= high and whole) or value == float("inf"):
        wanted = f"from {low} to {high}" if high < float("inf") else f">= {low}"
        refuse(f"{name} must be a {kind} {wanted} (got {given})")
    return value


def number_of(name, low, high=float("inf")):
    return one_number(name, config[name], low, high)


def numbers_of(name, low, high=float("inf")):
    """As values_of, of which each is a number."""
    return [one_number(name, value, low, high) for value in values_of(name)]


def one_whole_number(name, given, low, high=float("inf")):
    return int(one_number(name, given, low, high, "whole number"))


def whole_number_of(name, low, high=float("inf")):
    return one_whole_number(name, config[name], low, high)


def whole_numbers_of(name, low, high=float("inf")):
    """As values_of, of which each is a whole number."""
    return [one_whole_number(name, value, low, high) for value in values_of(name)]


def one_mapping(name, given, needed=(), more=None):
    """Its keys are those needed and some of `more`, any if that is None."""
    if not isinstance(given, dict):
        keys = f" with {', '.join(needed)}" if needed else ""
        refuse(f"{name} must be a mapping {{KEY: VALUE}}{keys} (got {given})")
    for key in needed:
        if key not in given:
            refuse(f"{name} must have {', '.join(needed)} (got {given})")
    for key in given:
        if more is not None and key not in (*needed, *more):
            refuse(f"{name} may have {', '.join((*needed, *more))} (got {key})")
    return given


def mapping_of(name, needed=(), more=None):
    """Empty if nothing is given."""
    return one_mapping(name, config[name] or {}, needed, more)


def mappings_of(name, needed=(), more=None):
    """A list of them, which may be empty."""
    given = config[name] or []
    return [one_mapping(f"each of {name}", each, needed, more)
            for each in (given if isinstance(given, list) else [given])]


def choices_of(name, allowed):
    """As values_of, of which each is one of those allowed."""
    for value in values_of(name):
        if value not in allowed:
            refuse(f"{name} must be among {', '.join(allowed)} (got {value})")
    return values_of(name)


def folder_given(name, default):
    return Path(_started_in, str(config[name])).resolve() if name in config else default


def stamp(name, *sources):
    """A file that is new whenever the sources are others."""
    path, text = ROOT / "build" / "studies" / f"{name}.version", _rows.sum_of(*sources) + "\n"
    if not path.exists() or path.read_text() != text:
        path.parent.mkdir(parents=True, exist_ok=True)
        unfinished = path.with_name(f"{path.name}.{os.getpid()}")
        unfinished.write_text(text)
        unfinished.replace(path)
    return str(path)


def need_programs(*names):
    """Refuses a program that is missing or older than what it is made of: a stamp is of sources, a
    result of programs."""
    for name in names:
        reason = _cases.why_not_to_be_run(name, BUILD)
        if reason:
            refuse(reason)


def need_kept(*tables):
    """Refuses kept=1 where there is nothing to make a page of."""
    for path in tables if KEPT else ():
        if not Path(path).exists():
            refuse(f"kept=1 makes figures and pages of {path}, which is not there: without kept=1 it is made")


def figure_files(stem):
    return [f"{stem}{ending}" for ending in _plots.endings()]


STUDY = HERE.name if HERE.parent.name == "studies" else HERE.relative_to(ROOT).as_posix()
_own = yaml.safe_load((HERE / "config.yaml").read_text())
for _name, _value in workflow.overwrite_config.items():   # snakemake puts mappings together
    if isinstance(_own.get(_name), dict):
        one_mapping(_name, _value)


configfile: str(HERE / "config.yaml")


# The folder in which snakemake was started; jobs are started in the working folder.
_started_in = os.environ.setdefault("STUDY_STARTED_IN", os.getcwd())
KEPT = truth("kept")
_plots.PDF = truth("pdf")
_known = {"kept", "pdf", "quick", "smoke", "build", "work", "results",
          *_own} - {"modes"}
for _name in workflow.overwrite_config:
    if _name not in _known:
        refuse(f"{_name} is not in its config.yaml (expected one of {', '.join(sorted(_known))})")
MODE = "smoke" if truth("smoke") else "quick" if truth("quick") else "full"
for _name, _value in (config.get("modes", {}).get(MODE) or {}).items():
    if _name not in workflow.overwrite_config:
        config[_name] = _value

BUILD = folder_given("build", ROOT / "build" / "release")
if "build" in config and not BUILD.is_dir():
    BUILD = (ROOT / str(config["build"])).resolve()
WORK = folder_given("work", ROOT / "build" / "studies" /
                    (STUDY if MODE == "full" else f"{STUDY}_{MODE}"))
_elsewhere = "results" in config or "work" in config or MODE != "full"
RESULTS = folder_given("results", WORK / "results" if _elsewhere else HERE / "results")
README = str((RESULTS if _elsewhere else HERE) / "README.md")
PLUGIN = stamp("plugin", *_rows.PLUGIN_SOURCES)
TOOLS = stamp("tools", *_rows.MEASURING_SOURCES, "postproc/tools")

# One timed job at a time; such a job also takes all threads: threads: workflow.cores.
workflow.global_resources.setdefault("timing", 1)


workdir: str(WORK)
