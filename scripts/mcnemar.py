# SPDX-License-Identifier: BSD-3-Clause
"""McNemar's test of two classifiers by the same items, exact: where one of them is right and the other wrong, either is as
probable. Items on which both are right or both are wrong say nothing; where no others are left, p is 1."""

import math


def p_different(only_first, only_second):
    """Two-sided, against "both are right as often"; numbers of items that one of them alone names rightly."""
    trials, fewer = only_first + only_second, min(only_first, only_second)
    return min(1.0, 2 * sum(math.comb(trials, k) for k in range(fewer + 1)) / 2 ** trials)
