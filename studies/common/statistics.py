# SPDX-License-Identifier: GPL-2.0-or-later
"""Means, errors, intervals and limits."""
from __future__ import annotations

from dataclasses import dataclass
from math import inf, log, nan, sqrt

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


def confidence_interval(values, level: float = 0.95) -> tuple[float, float]:
    """Student's interval for the mean of independent values of one normal distribution."""
    values = list(values)
    mean, error = mean_and_error(values)
    if len(values) < 2:
        return -inf, inf
    width = student(0.5 + level / 2, len(values) - 1) * error
    return mean - width, mean + width


@dataclass(frozen=True)
class Equivalence:
    difference: float  # mean of b minus mean of a
    low: float         # the interval of the two one-sided tests: 1 - 2 alpha
    high: float
    bound: float
    equivalent: bool   # the interval lies within ±bound


def equivalence(a, b, bound: float, alpha: float = 0.05, paired: bool = False) -> Equivalence:
    """Two one-sided tests (Schuirmann 1987): whether the means of a and b differ by less than
    `bound`. Unpaired: Welch's degrees of freedom; paired: of the differences b[i] - a[i]."""
    a, b = numpy.asarray(list(a), dtype=float), numpy.asarray(list(b), dtype=float)
    if bound <= 0:
        raise ValueError(f"the bound of an equivalence must be > 0 (got {bound})")
    if min(a.size, b.size) < 2 or (paired and a.size != b.size):
        raise ValueError(f"an equivalence needs two values or more of each, paired as many of "
                         f"both (got {a.size} and {b.size})")
    if paired:
        difference, error = mean_and_error(b - a)
        freedom = a.size - 1
    else:
        difference = float(b.mean() - a.mean())
        va, vb = a.var(ddof=1) / a.size, b.var(ddof=1) / b.size
        error = sqrt(va + vb)
        freedom = (va + vb) ** 2 / (va ** 2 / (a.size - 1) + vb ** 2 / (b.size - 1)) \
            if error > 0 else a.size + b.size - 2
    width = student(1 - alpha, freedom) * error if error > 0 else 0.0
    low, high = difference - width, difference + width
    return Equivalence(difference, low, high, bound, bool(-bound < low and high < bound))


def richardson(h, values) -> tuple[float, float]:
    """Limit of value(h) for h → 0 and the order p of value = limit + c h^p, from the three
    smallest h, which are a constant ratio apart. NaN if the differences do not fall as a power."""
    pairs = sorted(zip(map(float, h), map(float, values)))[:3]
    if len(pairs) < 3:
        raise ValueError(f"richardson needs three steps (got {len(pairs)})")
    (h1, v1), (h2, v2), (h3, v3) = pairs
    ratio = h2 / h1
    if ratio <= 1 or abs(h3 / h2 / ratio - 1) > 1e-6:
        raise ValueError(f"richardson needs steps of a constant ratio (got {h1}, {h2}, {h3})")
    if v2 == v1:
        return (v1, nan) if v3 == v2 else (nan, nan)
    quotient = (v3 - v2) / (v2 - v1)
    if quotient <= 1:
        return nan, nan
    return v1 - (v2 - v1) / (quotient - 1), log(quotient) / log(ratio)


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
