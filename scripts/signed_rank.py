# SPDX-License-Identifier: BSD-3-Clause
"""Wilcoxon's signed-rank test of paired values, exact: all signs of the differences are as probable. Differences of 0 are
left out; where none is left, p is 1."""


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
    # How many of the choices of signs reach each total: coefficients of the product of all 1 + x^rank, side by side in
    # one whole number, whose multiplication by x^rank is a shift.
    bytes_each = len(doubled_ranks) // 8 + 1
    ways = 1
    for rank in doubled_ranks:
        ways += ways << (8 * bytes_each * rank)
    above = ways >> (8 * bytes_each * reached)
    text = above.to_bytes((above.bit_length() + 7) // 8, "little")
    num_above = sum(int.from_bytes(text[i:i + bytes_each], "little") for i in range(0, len(text), bytes_each))
    return num_above / 2 ** len(doubled_ranks)


def p_different(a, b):
    """Two-sided, against "a and b are alike"."""
    return min(1.0, 2 * min(p_greater(a, b), p_greater(b, a)))
