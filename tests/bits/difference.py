#!/usr/bin/env python3
"""difference.py ONE OTHER: what differs between two files of `bits`, in one line. Exit code 0 if all that both tell is
the same to the bit, 1 if not.

A quantity that only one file tells (a field that one side does not store) is named, and is no difference."""
import math
import sys


# Quantities that are nothing but round-off (as the update error of FMPM) are not measured by themselves.
ROUND_OFF = 1e-12


def read(path):
    """Lines by what they tell: {what: [(line number, the line, its numbers)]}; numbers as they are written."""
    told = {}
    with open(path) as file:
        for number, line in enumerate(file, 1):
            words = line.split()
            told.setdefault(words[0], []).append((number, line.rstrip("\n"), words[1:]))
    return told


def value(word):
    return float.fromhex(word)


def scale_of(lines):
    """The largest number of a quantity: differences are relative to it, for what is nearly nothing may be all noise."""
    largest = 0.0
    for _, _, words in lines:
        for word in words[1:]:
            a = abs(value(word))
            if math.isfinite(a):
                largest = max(largest, a)
    return largest


def main(one, other):
    first, second = read(one), read(other)
    only = sorted(set(first) ^ set(second))
    note = "; only one side tells " + ", ".join(only) if only else ""
    earliest, most, worst, fewer, differing = None, 0.0, "", "", []
    for what in first:
        if what not in second:
            continue
        mine, theirs = first[what], second[what]
        if len(mine) != len(theirs):
            fewer = fewer or f"{what} is told {len(mine)} and {len(theirs)} times"
        scale = max(scale_of(mine), scale_of(theirs))
        if scale < ROUND_OFF:
            scale = 1.0
        for (number, text, a), (_, text_of_other, b) in zip(mine, theirs):
            if a == b:
                continue
            if what not in differing:
                differing.append(what)
            if earliest is None or number < earliest[0]:
                earliest = (number, text, text_of_other)
            if len(a) != len(b) or a[0] != b[0]:
                most, worst = math.inf, what
                continue
            for p, q in zip(a[1:], b[1:]):
                if p == q:
                    continue
                off = abs(value(p) - value(q))
                share = off / scale if scale > 0 and math.isfinite(off) else (0.0 if off == 0 else math.inf)
                if share >= most:
                    most, worst = share, what
    if earliest is None and not fewer:
        print("same" + note)
        return 0
    parts = []
    if fewer:
        parts.append(fewer)
    if earliest:
        if most == math.inf:
            how_much = f"{worst} by more than numbers"
        elif most == 0:
            how_much = "by signs of zeros"
        else:
            how_much = f"most by {most:.1e} of the largest {worst}"
        named = ", ".join(differing[:4]) + (f" and {len(differing) - 4} more" if len(differing) > 4 else "")
        parts.append(f"differs in {named}, {how_much}")
        print("; ".join(parts) + note + f"; first in line {earliest[0]}:")
        print("    < " + earliest[1])
        print("    > " + earliest[2])
    else:
        print("; ".join(parts) + note)
    return 1


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    try:
        code = main(sys.argv[1], sys.argv[2])
    except (OSError, ValueError, IndexError) as e:
        print(f"cannot be compared: {e}")
        code = 1
    sys.exit(code)
