# SPDX-License-Identifier: GPL-2.0-or-later
"""studies/common: runs, logs, rows, statistics, pages."""
import math

import pandas
import pytest

from studies.common import cases, pages, rows, statistics


# 1, 2, 3, 6: mean 3, squares about it 4 + 1 + 0 + 9 = 14, error sqrt(14/(4 3)).
def test_mean_and_standard_error():
    mean, error = statistics.mean_and_error([6, 1, 3, 2])
    assert mean == pytest.approx(3)
    assert error == pytest.approx(math.sqrt(14 / 12))
    assert statistics.mean_and_error([7])[0] == 7
    assert math.isnan(statistics.mean_and_error([7])[1])


# Student's t of 97.5 % for three degrees of freedom is 3.182446 (tables).
def test_confidence_interval():
    low, high = statistics.confidence_interval([6, 1, 3, 2])
    assert high - 3 == pytest.approx(3.182446 * math.sqrt(14 / 12), rel=1e-6)
    assert 3 - low == pytest.approx(high - 3)
    assert statistics.confidence_interval([1]) == (-math.inf, math.inf)


# 2 + 3 h² at h = 0.1, 0.2, 0.4: limit 2, order 2, to round-off.
def test_richardson_gives_limit_and_order():
    h = [0.4, 0.1, 0.2]
    limit, order = statistics.richardson(h, [2 + 3 * x * x for x in h])
    assert limit == pytest.approx(2, abs=1e-13)
    assert order == pytest.approx(2, abs=1e-10)


def test_pareto_front():
    assert statistics.pareto_front([1, 2, 2, 3, 4], [5, 3, 2, 2, 1]) == [0, 2, 4]
    assert statistics.pareto_front([1, 2], [math.nan, 3]) == [1]


LOG = """some words
Step KinEng contacts contacts contacts
       0  1.5  0  0.1 0.2
WARNING: something happened
      10  2.5  1  0.3 nan
Loop time of 0.5 on 1 procs for 10 steps with 1 atoms
Step Temp
      10  7
Loop time of 0.25 on 1 procs for 0 steps with 1 atoms
"""


def test_read_log(tmp_path):
    path = tmp_path / "log"
    path.write_text(LOG)
    first, second = cases.read_log(path)
    assert list(first.columns) == ["Step", "KinEng", "contacts", "contacts.2", "contacts.3"]
    assert list(first["Step"]) == [0, 10]
    assert first["contacts.2"].iloc[1] == 0.3
    assert math.isnan(first["contacts.3"].iloc[1])
    assert second["Temp"].iloc[0] == 7
    path.write_text("nothing\n")
    with pytest.raises(cases.CaseError, match="has no table"):
        cases.read_log(path)


def test_failures_are_seen():
    assert cases.failure("all well\n", 0) is None
    assert cases.failure("x\nERROR: in.rods: rods must be > 0 (got 0)\n", 0) == \
        "ERROR: in.rods: rods must be > 0 (got 0)"
    assert cases.failure("SIGINT/SIGTERM caught - quitting on first occasion.", 0) == \
        "stopped by a signal"
    assert cases.failure("", -9) == "ended by signal 9"
    assert cases.failure("a\nb\n", 3) == "exit code 3: b"


def test_run_deck(tmp_path, programs):
    deck = tmp_path / "in.words"
    deck.write_text("print 'lambda ${lambda}'\nif '${lambda} < 1' then &\n"
                    "  \"print 'ERROR: lambda must be >= 1'\" quit\n")
    run = cases.run_deck(tmp_path, "in.words", {"lambda": 10}, build=programs)
    assert run.command == "lmp -in in.words -log log.words -var lambda 10"
    assert "lambda 10" in run.log.read_text()
    assert run.loop_seconds == 0 and run.cpu_seconds > 0
    with pytest.raises(cases.CaseError, match=r"^ERROR: lambda must be >= 1 \(in "):
        cases.run_deck(tmp_path, "in.words", {"lambda": 0}, build=programs)
    with pytest.raises(cases.CaseError, match="lmp is not there: scripts/build makes it"):
        cases.run_deck(tmp_path, "in.words", build=tmp_path)


def test_rows(tmp_path):
    rows.write_rows(tmp_path / "a.csv", [{"k": 2, "x": 1 / 3}, {"k": 1, "x": 2.0}])
    rows.write_rows(tmp_path / "b.csv", pandas.DataFrame({"k": [1], "x": [1e-20]}))
    rows.collect([tmp_path / "a.csv", tmp_path / "b.csv"], tmp_path / "c.csv", by=["k"])
    assert (tmp_path / "c.csv").read_text() == "k,x\n1,2\n1,1e-20\n2,0.3333333333\n"


def test_provenance():
    row = rows.provenance("lmp -in in.fill", 86028121)
    assert list(row) == list(rows.PROVENANCE)
    assert len(row["version"]) == 12
    assert "core" in row["machine"]


def test_numbers_of_pages():
    assert [pages.figure(x) for x in (0.000123456, 45.64, 12345, 0.9999, 0)] == \
        ["0.000123", "45.6", "12300", "1.00", "0"]
    assert pages.power(6.1e-6) == "6·10⁻⁶"
    assert pages.with_error((0.34567, 0.0032)) == "0.3457 ± 0.0032"
    assert pages.with_error((0.34567, math.nan)) == "0.3457"


def test_a_page_needs_all_its_values(tmp_path):
    template = tmp_path / "p.md.j2"
    template.write_text("{{ a | figure(2) }}\n")
    pages.render(template, tmp_path / "p.md", {"a": 0.1234})
    assert (tmp_path / "p.md").read_text() == "0.12\n"
    with pytest.raises(Exception, match="'a' is undefined"):
        pages.render(template, tmp_path / "p.md", {})


def test_a_study_runs_and_is_not_run_again(study, tmp_path):
    done = study("tests/studies/tiny", "smoke=1")
    assert done.returncode == 0, done.stdout
    assert (tmp_path / "results/README.md").read_text() == "0.01025 J after 10 steps\n"
    assert (tmp_path / "results/energy.svg").exists()
    assert "Nothing to be done" in study("tests/studies/tiny", "smoke=1").stdout
    refused = study("tests/studies/tiny", "smoke=1", "steps=0")
    assert refused.returncode != 0 and "tiny: steps must be >= 1 (got 0)" in refused.stdout
