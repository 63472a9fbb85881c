# SPDX-License-Identifier: BSD-3-Clause
"""Wilcoxon's signed-rank test of paired values, exact: all signs of the differences are as probable. Differences of 0 are
left out; where none is left, p is 1."""

import collections


def p_greater(a, b):
    """One-sided, against "a is not larger than b"."""
    differences = sorted((x - y for x, y in zip(a, b, strict=True) if x != y), key=abs)
    doubled_ranks, i = [], 0
    while i < len(differences):
        k = i
        while k < len(differences) and abs(differences[k]) == abs(differences[i]):
            k += 1
        doubled_ranks += [i + 1 + k] * (k - i)
        i = k
    reached = sum(rank for rank, d in zip(doubled_ranks, differences) if d > 0)
    ways = collections.Counter({0: 1})
    for rank in doubled_ranks:
        more = collections.Counter(ways)
        for total, count in ways.items():
            more[total + rank] += count
        ways = more
    return sum(count for total, count in ways.items() if total >= reached) / 2 ** len(doubled_ranks)


def p_different(a, b):
    """Two-sided, against "a and b are alike"."""
    return min(1.0, 2 * min(p_greater(a, b), p_greater(b, a)))
