# SPDX-License-Identifier: GPL-2.0-or-later
"""Means, errors, equivalence and limits."""
from __future__ import annotations

from dataclasses import dataclass
from math import inf, nan, sqrt

import numpy


def mean_and_error(values) -> tuple[float, float]:
    """Mean and its standard error, which is NaN for a single value."""
    values = numpy.asarray(list(values), dtype=float)
    if values.size == 0:
        return nan, nan
    if values.size == 1:
        return float(values[0]), nan
    return float(values.mean()), float(values.std(ddof=1) / sqrt(values.size))


def student(part: float, freedom: float) -> float:
    """Student's t below which `part` of its distribution lies."""
    from scipy import stats  # takes longer to load than most jobs to do
    return float(stats.t.ppf(part, freedom))


@dataclass(frozen=True)
class Equivalence:
    difference: float  # mean of b over mean of a, minus 1; of several pairs their mean
    low: float         # the interval of the two one-sided tests: 1 - 2 alpha
    high: float
    bound: float
    equivalent: bool   # the interval lies within ±bound


def equivalence(pairs, bound: float, alpha: float = 0.05, paired: bool = False) -> Equivalence:
    """Two one-sided tests (Schuirmann 1987): whether the means of a and b, of each of the `pairs`
    (a, b) of samples, differ by less than `bound` of that of a, in the mean over the pairs. To first
    order in the errors of the means, with Welch's degrees of freedom. paired: values of a and b in the
    same place belong together, and the scatter that they share does not count."""
    if bound <= 0:
        raise ValueError(f"the bound of an equivalence must be > 0 (got {bound})")
    difference, parts = 0.0, []   # variance of a mean, its degrees of freedom
    for pair in pairs:
        a, b = (numpy.asarray(list(values), dtype=float) for values in pair)
        if min(a.size, b.size) < 2 or (paired and a.size != b.size):
            raise ValueError("an equivalence needs two values or more of each "
                             f"{'and as many, ' if paired else ''}(got {a.size} and {b.size})")
        ratio = b.mean() / a.mean()
        difference += float(ratio - 1) / len(pairs)
        scale = 1.0 / a.mean() / len(pairs)
        for values in ([b - ratio * a] if paired else [ratio * a, b]):
            parts.append((scale ** 2 * values.var(ddof=1) / values.size, values.size - 1))
    variance = sum(part for part, _ in parts)
    width = 0.0
    if variance > 0:
        freedom = variance ** 2 / sum(part ** 2 / free for part, free in parts)
        width = student(1 - alpha, freedom) * sqrt(variance)
    low, high = difference - width, difference + width
    return Equivalence(difference, low, high, bound, bool(-bound < low and high < bound))


def limit_of_line(x, y, errors) -> tuple[float, float, float]:
    """Where the straight line through values y with standard errors, by weighted least squares, meets
    x = 0; its standard error, from those of the values; and chi squared a degree of freedom, NaN of
    two values."""
    x, y, errors = (numpy.asarray(list(v), dtype=float) for v in (x, y, errors))
    if x.size < 2 or not (errors > 0).all():
        raise ValueError("a line needs two values or more, with errors > 0 "
                         f"(got {x.size} and {errors.tolist()})")
    weights = errors ** -2
    about = numpy.average(x, weights=weights)
    spread = (weights * (x - about) ** 2).sum()
    if spread == 0:
        raise ValueError(f"a line needs two places (got {x.tolist()})")
    slope = (weights * (x - about) * y).sum() / spread
    limit = numpy.average(y, weights=weights) - slope * about
    error = sqrt(1.0 / weights.sum() + about ** 2 / spread)
    chi = (weights * (y - limit - slope * x) ** 2).sum()
    return float(limit), error, float(chi / (x.size - 2)) if x.size > 2 else nan


def pareto_front(cost, error) -> list[int]:
    """Indices of the points that no other beats in both, in the order of their cost. Points with a
    NaN are on no front."""
    order = sorted((c, e, i) for i, (c, e) in enumerate(zip(cost, error)) if c == c and e == e)
    front, best = [], inf
    for _, e, i in order:
        if e < best:
            front.append(i)
            best = e
    return front
