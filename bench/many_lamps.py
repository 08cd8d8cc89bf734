#!/usr/bin/env python3
"""The room cornell with its lamp in N x N pieces: do frame times depend on the number of lamps?

    bench/many_lamps.py cornell.obj many.obj [--side 8]

Bake both and give them to path_table.
"""

import argparse


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("room")
    parser.add_argument("output")
    parser.add_argument("--side", type=int, default=8)
    options = parser.parse_args()
    lines = open(options.room).read().splitlines()
    vertices = [[float(x) for x in line.split()[1:4]] for line in lines if line.startswith("v ")]
    start = lines.index("usemtl light") + 1
    corners = [vertices[int(w.split("/")[0]) - 1] for w in lines[start].split()[1:4]]

    def point(u, v):
        a, b, c = corners
        return [a[i] + u * (b[i] - a[i]) + v * (c[i] - b[i]) for i in range(3)]

    pieces, n, gap = [], options.side, 0.1 / options.side
    for i in range(n):
        for j in range(n):
            low, high = (i / n + gap, j / n + gap), ((i + 1) / n - gap, (j + 1) / n - gap)
            for u, v in [low, (high[0], low[1]), high, (low[0], high[1])]:
                pieces.append("v {:.6f} {:.6f} {:.6f}".format(*point(u, v)))
            pieces += ["f -4 -3 -2", "f -4 -2 -1"]
    with open(options.output, "w") as stream:
        stream.write("\n".join(lines[:start] + pieces + lines[start + 2:]) + "\n")


if __name__ == "__main__":
    main()
