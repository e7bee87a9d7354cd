# SPDX-License-Identifier: GPL-2.0-or-later
"""studies/packing: the numbers of its figures, its pages, and its smallest run from end to end."""
import re
import shutil
import subprocess
from math import e, isnan, nan, pi, sqrt

import numpy
import pandas
import pytest

from conftest import ROOT
from studies.common import plots, rows, settling
from studies.packing import beds, figures, measures, page

STUDY = ROOT / "studies" / "packing"


def bed(aspect=10, limits="none", seed=1, friction=0.2, **values):
    row = {"lambda": aspect, "friction": friction, "limits": limits, "seed": seed, "rods": 500, "vf_inner": 0.4,
           "vf_whole": 0.35, "vf_theory": measures.parkhouse_kelly(aspect),
           "vf_random_contacts": 0.45, "mean_elevation_deg": 13.0, "mean_sin_gamma": 0.7,
           "nematic_order": -0.3, "contacts_per_rod": 6.0, "mean_overlap_over_diameter": 1e-3,
           "largest_overlap_over_diameter": 1e-2, "momentary_overlap_over_diameter": 0.2,
           "energy_J": 1e-9}
    return {**row, **values}


def means(*given):
    return measures.packing_means(pandas.DataFrame(list(given)))


def test_beds_of_one_kind_are_averaged():
    table = means(bed(seed=1, vf_inner=0.40, energy_J=1), bed(seed=2, vf_inner=0.44, energy_J=3),
                  bed(20, vf_inner=0.2), bed(limits="study"))
    assert list(table["beds"]) == [2, 1, 1]
    two = table[(table["lambda"] == 10) & (table["limits"] == "none")].iloc[0]
    assert two["vf_inner"] == pytest.approx(0.42)
    assert two["vf_inner_error"] == pytest.approx(0.02)  # half the difference of two
    assert two["energy_J"] == 3
    assert isnan(table[table["lambda"] == 20].iloc[0]["vf_inner_error"])  # of one bed


# By hand for lambda = 20: V_p = 19/4 + 1/6, V_ex = 361 (2 s/pi) + 38 + 4/3, V_f = 10.5 V_p/V_ex.
def test_theory():
    assert measures.parkhouse_kelly(20) == pytest.approx(0.2995732, abs=1e-6)
    assert measures.random_contacts(20, measures.ISOTROPIC_SIN_GAMMA) == pytest.approx(0.2348370, abs=1e-6)
    assert measures.random_contacts(20, measures.HORIZONTAL_SIN_GAMMA) == pytest.approx(0.2780903, abs=1e-6)
    assert means(bed(20, mean_sin_gamma=pi / 4)).iloc[0]["vf_expected"] == pytest.approx(0.2348370, abs=1e-6)
    assert isnan(means(bed(4)).iloc[0]["vf_expected"])  # not for short rods
    # Aligned rods touch at few places: 10.5 (19/4 + 1/6)/(38 + 4/3) = 1.31 is no fraction.
    assert isnan(means(bed(20, mean_sin_gamma=0.0)).iloc[0]["vf_expected"])
    # Mean elevation of isotropic axes: ∫ a cos a da over 0..pi/2, by the midpoint rule.
    a = (numpy.arange(10000) + 0.5) * pi / 20000
    assert measures.ISOTROPIC_ELEVATION_DEG == pytest.approx(
        numpy.degrees((a * numpy.cos(a)).sum() * pi / 20000), abs=1e-5)


def test_tables_that_cannot_be_right_are_refused(tmp_path):
    def refused(words, *given):
        rows.write_rows(tmp_path / "beds.csv", given)
        with pytest.raises(ValueError, match=words):
            measures.read_beds(tmp_path / "beds.csv")
    refused("two rows for one bed", bed(), bed())
    refused("vf_inner is 1.01, wanted from 0 to 1", bed(), bed(20, vf_inner=1.01))
    refused("mean_sin_gamma is nan", bed(), bed(20, mean_sin_gamma=nan))
    (tmp_path / "l.csv").write_text("lambda,vf,vf_error,kind,label,source\n0.5,0.1,,a,b,c\n")
    with pytest.raises(ValueError, match="l.csv: b: wanted lambda >= 1"):
        measures.read_literature(tmp_path / "l.csv")


def bins(*given):
    """Rows seed, low, high, density, with the error 0.1 of their counts, of 100 isotropic rods."""
    return pandas.DataFrame([{
        "lambda": 10, "friction": 0.2, "limits": "none", "seed": seed, "elevation_low_deg": low,
        "elevation_high_deg": high, "density": density, "density_error": 0.1,
        "isotropic_fraction": 0.5, "isotropic_scatter": 0.05} for seed, low, high, density in given])


# One bed keeps the error of its counts; n beds scatter sqrt(n) less than one if isotropic.
def test_orientation_over_beds():
    one = measures.elevation_means(bins((1, 0, 30, 1.5), (1, 30, 90, 0.5)))
    assert list(one["density"]) == [1.5, 0.5]
    assert list(one["error"]) == [0.1, 0.1]
    assert one["isotropic_scatter"][0] == pytest.approx(0.1)
    assert one["isotropic_rods"][0] == pytest.approx(100)  # sqrt(0.5 0.5/100) = 0.05
    two = measures.elevation_means(bins((1, 0, 30, 1.5), (2, 0, 30, 1.7))).iloc[0]
    assert two["density"] == pytest.approx(1.6)
    assert two["error"] == pytest.approx(0.1)
    assert two["isotropic_scatter"] == pytest.approx(0.1 / sqrt(2))
    assert two["isotropic_rods"] == pytest.approx(200)
    with pytest.raises(ValueError, match="the bin from 30 to 90 degrees has 1 rows for 2 beds"):
        measures.elevation_means(bins((1, 0, 30, 1.5), (1, 30, 90, 1), (2, 0, 30, 1)))
    with pytest.raises(ValueError, match="2 rows for 1 beds"):
        measures.elevation_means(bins((1, 0, 30, 1.5), (1, 0, 30, 1.5)))


def drawn(axes, label):
    """x, y and error of what the key calls so."""
    handles, labels = axes.get_legend_handles_labels()
    container = handles[[text.startswith(label) for text in labels].index(True)]
    line, _, bars = container
    x, y = line.get_data()
    half = [(segment[1][1] - segment[0][1]) / 2 for segment in bars[0].get_segments()] if bars else None
    return list(x), list(y), half


def published(*given):
    return pandas.DataFrame(given, columns=["lambda", "vf", "vf_error", "kind", "label", "source"])


def test_what_figure_3_shows():
    table = means(bed(10, seed=1, vf_inner=0.40), bed(10, seed=2, vf_inner=0.44),
                  bed(20, seed=1, vf_inner=0.20), bed(20, seed=2, vf_inner=0.22),
                  bed(20, "study", vf_inner=0.25))
    figure, left_out = figures.packing_figure(table, published(
        [6.8, 0.58, 0.01, "experiment", "fibres", ""], [100, 0.04, nan, "simulation", "far", ""]))
    axes = figure.axes[0]
    x, y, half = drawn(axes, "no limit on ω, friction 0.2, 2 beds each")
    assert x == [10, 20] and y == pytest.approx([0.42, 0.21]) and half == pytest.approx([0.02, 0.01])
    assert drawn(axes, "limits of the study on ω, friction 0.2, one bed") == ([20], [0.25], None)
    assert drawn(axes, "fibres")[:2] == ([6.8], [0.58])
    assert left_out == ["far at λ = 100, V_f = 0.04 is beyond the axes"]
    texts = [text.get_text() for text in axes.get_legend().get_texts()]
    assert texts == ["limits of the study on ω, friction 0.2, one bed",
                     "no limit on ω, friction 0.2, 2 beds each",
                     "random contacts at these beds' orientation", "fibres"]


def test_curves_of_figure_3():
    curves = {name: (x, y) for name, x, y, _, _ in figures.theory_curves(40)}
    assert curves["Parkhouse & Kelly"][0][0] == pytest.approx(e)
    assert numpy.interp(20, *curves["random, isotropic"]) == pytest.approx(0.2348, abs=2e-4)
    assert numpy.interp(20, *curves["random, horizontal"]) == pytest.approx(0.2781, abs=2e-4)
    x, y = figures.expected_curve(means(bed(10, mean_sin_gamma=0.6), bed(30, mean_sin_gamma=0.7)))
    assert numpy.interp(20, x, y) == pytest.approx(measures.random_contacts(20, 0.65), abs=2e-4)
    assert len(figures.expected_curve(means(bed(10)))[0]) == 0


def rods_of(level, **kind):
    """A bed's distribution of elevation: that part of its rods below the third of the sphere."""
    return pandas.DataFrame([{**kind, "elevation_low_deg": low, "elevation_high_deg": high, "fraction": part}
                             for low, high, part in ((0, 19.4712206, level), (19.4712206, 90, 1 - level))])


# V_f = (1 - below) 2 ln λ/λ; the whole vessel's is (1 - apart) of it; energy over rods m g D.
def test_what_the_study_states_is_judged_by_its_numbers():
    def judged(below, apart, level, moving, friction=0.2):
        beds, levels = [], []
        for aspect, part in zip((10, 20, 30), below):
            inner = (1 - part) * measures.parkhouse_kelly(aspect)
            weight = 9.81 * 0.01 * settling.mass_of(aspect)
            beds.append(bed(aspect, "study", friction=friction, vf_inner=inner, rods=500,
                            vf_whole=(1 - apart) * inner, energy_J=500 * moving * weight))
            levels.append(rods_of(level, **{"lambda": aspect, "friction": friction, "limits": "study",
                                            "seed": 1}))
        return pandas.DataFrame(beds), pandas.concat(levels)

    def verdict(*settings):
        beds, levels = (pandas.concat(parts) for parts in zip(*settings))
        return page.verdict(measures.verdicts(beds, measures.packing_means(beds), levels))
    good = verdict(judged((0.02, 0.05, 0.09), 0.05, 0.6, 1e-6))
    assert good["all_hold"] == "limits of the study on ω, friction 0.2" and not good["fails"]
    assert good["lines"][0][1:] == ["yes", "yes (60, 60 and 60 %)", "yes (−5, −5 and −5 %)",
                                    "yes (−2, −5 and −9 %)"]
    bad = verdict(judged((0.02, 0.32, 0.47), 0.2, 0.4, 1e-4))
    assert bad["lines"][0][1:] == ["no", "no (40, 40 and 40 %)", "no (−20, −20 and −20 %)",
                                   "at λ = 10 (−2, −32 and −47 %)"]
    assert not bad["all_hold"] and not bad["holds"] and not bad["near"]
    both = verdict(judged((0.16, 0.32, 0.47), 0.2, 0.6, 1e-6),
                   judged((-0.02, 0.01, 0.05), 0.05, 0.6, 1e-6, friction=0.0))
    assert both["holds"] == "beds come to rest and most rods are near horizontal"
    assert both["nearest"] == "limits of the study on ω, friction 0" and both["near"]
    assert both["nearest_away"] == "+2, −1 and −5 %" and not both["all_hold"]  # above at λ = 10


def test_kept_rows_of_other_kinds_stay(tmp_path):
    rows.write_rows(tmp_path / "former.csv", [bed(vf_inner=0.1), bed(seed=2, vf_inner=0.1)])
    rows.write_rows(tmp_path / "new.csv", [bed(friction=0.0, vf_inner=0.3)])
    measures.collect([tmp_path / "new.csv"], tmp_path / "former.csv", tmp_path / "all.csv")
    assert list(rows.read_rows(tmp_path / "all.csv")["vf_inner"]) == [0.3, 0.1, 0.1]
    rows.write_rows(tmp_path / "new.csv", [bed(seed=3, vf_inner=0.3)])   # of a kind that is made anew
    measures.collect([tmp_path / "new.csv"], tmp_path / "former.csv", tmp_path / "all.csv")
    assert list(rows.read_rows(tmp_path / "all.csv")["seed"]) == [3]


# Bins equal in solid angle are equally wide: sin 30 degrees = 1/2, so that the middles of the bins
# are at 1/4 and 3/4. The band is that of the kind with fewest rods.
def test_what_figure_4_shows():
    one = bins((1, 0, 30, 1.5), (1, 30, 90, 0.5))
    figure = figures.elevation_figure(measures.elevation_means(one))
    x, y, half = drawn(figure.axes[0], "λ = 10, one bed")
    assert x == pytest.approx([0.25, 0.75]) and y == [1.5, 0.5] and half == pytest.approx([0.1, 0.1])
    more = bins((1, 0, 30, 1.5), (2, 0, 30, 1.5), (1, 30, 90, 0.5), (2, 30, 90, 0.5))
    more["lambda"] = 20
    figure = figures.elevation_figure(measures.elevation_means(pandas.concat([one, more])))
    assert "±1 s.d. of 100 isotropic rods" in [t.get_text() for t in figure.axes[0].texts]
    assert [t.get_text() for t in figure.axes[0].get_legend().get_texts()] == \
        ["λ = 10, one bed", "λ = 20, 2 beds"]


# Relative luminance of sRGB as the Web Content Accessibility Guidelines (2.1) define it; they want a
# contrast of 4.5 of letters to their ground, here white.
def test_letters_are_dark_enough():
    def contrast_to_white(colour):
        parts = [int(colour[i:i + 2], 16) / 255 for i in (1, 3, 5)]
        linear = [c / 12.92 if c <= 0.03928 else ((c + 0.055) / 1.055) ** 2.4 for c in parts]
        return 1.05 / (numpy.dot([0.2126, 0.7152, 0.0722], linear) + 0.05)
    assert contrast_to_white("#ffffff") == pytest.approx(1)
    assert contrast_to_white("#000000") == pytest.approx(21)
    for name in ("black", "green", "purple", "grey"):
        assert contrast_to_white(plots.for_letters(plots.COLOURS[name])) >= 4.5, name


def test_labels_stand_apart():
    assert figures.spread([0.3, 0.1, 0.11], 0.05) == pytest.approx([0.3, 0.1, 0.15])


def test_published_values_have_a_source():
    table = measures.read_literature(STUDY / "literature.csv")
    assert (table["source"].str.len() > 20).all()
    assert not table["source"].str.contains("recalled|memory").any()


def test_variables_of_a_deck(tmp_path):
    (tmp_path / "in.x").write_text("variable a index 1.5 # b\nvariable a index 2\n"
                                   "variable out index .\n  \"variable c index 3\"\n")
    assert beds.deck_variables(tmp_path / "in.x") == {"a": 1.5}


# The kept page is what the template makes of the kept tables.
def test_the_kept_page_is_that_of_the_kept_tables(study, tmp_path):
    shutil.copytree(STUDY / "results", tmp_path / "results")
    done = study("packing", "kept=1")
    assert done.returncode == 0, done.stdout
    made = (tmp_path / "results/README.md").read_text()
    kept = (STUDY / "README.md").read_text()
    assert made == re.sub(r"\((results/)", "(", kept)
    assert (tmp_path / "results/figure3.svg").read_bytes() == \
        (STUDY / "results/figure3.svg").read_bytes()
    assert (tmp_path / "results/report.html").read_bytes() == \
        (STUDY / "results/report.html").read_bytes()


# What a template says itself are limits of the study, theory and how the thing is used.
def test_templates_hold_no_measured_numbers():
    told_apart = re.compile(r"\{\{.*?\}\}|\{%.*?%\}|`[^`]*`|<[^>]*>|```.*?```|<pre>.*?</pre>", re.DOTALL)
    for name in ("README.md.j2", "report.html.j2"):
        text = told_apart.sub(" ", (STUDY / name).read_text())
        found = set(re.findall(r"(?<![\w.])\d+\.\d+|\d+(?= ?%)", text))
        assert found <= {"0.2"}, (name, found)  # of 0.2π rad/s


def test_the_smallest_run(study, tmp_path, programs):
    done = study("packing", "smoke=1")
    assert done.returncode == 0, done.stdout
    results = tmp_path / "results"
    table = measures.read_beds(results / "beds.csv")
    assert list(table["lambda"]) == [10] * 4 + [20] * 4
    assert list(table["friction"]) == [0, 0, 0.2, 0.2] * 2
    assert set(table["limits"]) == {"none", "study"}
    assert (table["time_s"] == 1.4).all() and (table["rods"] == 60).all()
    for column in rows.PROVENANCE:
        assert table[column].notna().all()
    assert (table["version"] == rows.version()).all()
    # Theory of the page and of rod_packing is one.
    assert table["vf_theory"].to_numpy() == pytest.approx(measures.parkhouse_kelly(table["lambda"]).to_numpy())
    assert table["vf_random_contacts"].to_numpy() == pytest.approx(
        measures.random_contacts(table["lambda"], table["mean_sin_gamma"]).to_numpy(), rel=1e-6)

    html = (results / "report.html").read_text()
    assert len(html) < 2_000_000
    assert html.count("<img") == 5 + 8 + 2
    assert not re.search(r"(src|href)=\"(?!data:)", html)
    assert "This is the smoke version" in html
    first = table.iloc[0]
    assert f"<td>{first['vf_inner']:.4f}</td>" in html
    assert f"{first['vf_inner']:.4f}" in (results / "README.md").read_text()

    # Beds of one kind beside those that are there: nothing else is asked for.
    added = study("packing", "smoke=1", "friction=0", "add=1", options=["-n"])
    assert added.returncode == 0 and "draw_filling" not in added.stdout, added.stdout
    assert (tmp_path / "former_beds.csv").read_bytes() == (results / "beds.csv").read_bytes()

    # Nothing to do again; a bed whose measures are lost is measured from its dump.
    assert "Nothing to be done" in study("packing", "smoke=1").stdout
    (tmp_path / f"lambda10_friction0_limits_none_seed{first['seed']}/bed.csv").unlink()
    (results / "beds.csv").unlink()
    again = study("packing", "smoke=1")
    assert again.returncode == 0, again.stdout
    assert "rule measure" in again.stdout and "rule pour" not in again.stdout
    assert len(measures.read_beds(results / "beds.csv")) == 8

    # The commands of the page, as they can be pasted from the project's folder.
    pasted = tmp_path / "pasted"
    shutil.copytree(ROOT / "input", pasted / "input")
    (pasted / "build").mkdir()
    (pasted / "build/release").symlink_to(programs)
    commands = re.search(r"<pre>(.*?)</pre>", html, re.DOTALL).group(1)
    shell = subprocess.run(["bash", "-e", "-c", commands.replace("&#34;", '"').replace("&amp;", "&")],
                           cwd=pasted, text=True, capture_output=True,
                           env={"PATH": "/usr/bin:/bin", "OMPI_MCA_ess_singleton_isolated": "1",
                                "OMPI_MCA_orte_tmpdir_base": str(tmp_path), "HOME": str(tmp_path)})
    assert shell.returncode == 0, shell.stdout[-2000:] + shell.stderr
    assert (pasted / "build/one_bed/figure1_5.png").exists()
    by_hand = rows.read_rows(pasted / "build/one_bed/packing.csv").iloc[-1]
    shown = table[(table["lambda"] == 20) & (table["limits"] == "none") &
                  (table["friction"] == 0.2)].iloc[0]
    assert by_hand["vf_inner"] == pytest.approx(shown["vf_inner"], rel=1e-9)


@pytest.mark.parametrize("setting, words", [
    ("seeds=0", "packing: seeds must be a whole number from 1 to 10 (got 0)"),
    ("friction=-1", "packing: friction must be a number >= 0 (got -1"),
    ("add=1", "beds.csv is not there: without add=1 it is made anew"),
    ("seeds=many", "packing: seeds must be a whole number from 1 to 10 (got many)"),
    ("lambdas=[10,inf]", "packing: lambdas must be a number >= 1 (got inf)"),
    ("lambdas=[15]", "packing: lambda 15 is not in Table 1 of the study"),
    ("limits=[some]", "packing: limits must be among study, none (got some)"),
    ("sedes=2", "packing: sedes is not in its config.yaml (expected one of add, "),
    ("quick=maybe", "packing: quick must be 0 or 1 (got 'maybe')"),
    ("build=/nowhere", "lmp is not there: scripts/build makes it")])
def test_wrong_settings_are_refused(study, setting, words):
    done = study("packing", setting, cores=1)
    assert done.returncode != 0 and words in done.stdout, done.stdout
