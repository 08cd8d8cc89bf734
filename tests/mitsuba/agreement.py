"""Whether two sets of measurements agree within their errors."""

import math

import numpy as np


def largest_allowed(count):
    """|z| that the largest of `count` normal values exceeds once in a thousand runs, about."""
    return 3.3 + 0.6 * math.log10(max(1, count))


def judge(title, ours, our_error, theirs, their_error, batches=math.inf):
    """Prints one line; True if ours and theirs, arrays of (values, 3 channels), agree within their
    standard errors. `batches`: from how many values the errors were estimated."""
    error = np.sqrt(our_error**2 + their_error**2)
    scale = np.maximum(np.abs(theirs), 1e-12)
    known = error > 1e-6 * scale  # what both know exactly must be equal
    z = np.where(known, (ours - theirs) / np.where(known, error, 1), 0)
    exact = bool(np.all(np.abs(ours - theirs)[~known] <= 1e-4 * scale[~known]))
    count = max(1, int(known.sum()))
    # One false alarm in a thousand runs: Bonferroni for the largest, normal for the mean square,
    # with the channels taken for one value. Estimated errors widen z a little.
    square_allowed = 1 + 2 / (batches - 3) + 3.3 * math.sqrt(2 / (count / 3))
    largest, square = float(np.abs(z).max()), float((z**2).sum() / count)
    agrees = exact and largest <= largest_allowed(count) and square <= square_allowed
    total = ours.sum() / theirs.sum() - 1
    print(f"{'ok  ' if agrees else 'FAIL'} {title:24} {count:5} values: "
          f"max |z| {largest:.2f} (<= {largest_allowed(count):.2f}), "
          f"mean z^2 {square:.2f} (<= {square_allowed:.2f}); "
          f"error {100 * np.median((error / scale)[known]):.2f} %, total {100 * total:+.3f} %",
          flush=True)
    return agrees


def judge_margin(title, ours, theirs, their_error, margin, places):
    """Prints one line; True if each of ours, (places, 3 channels), is within `margin`, relatively,
    of theirs, noise of theirs apart."""
    deviation, error = ours / theirs - 1, their_error / theirs
    z = np.maximum(0, np.abs(deviation) - margin) / error
    allowed = largest_allowed(z.size)
    agrees = bool(z.max() <= allowed)
    worst = np.unravel_index(z.argmax(), z.shape)
    percent = [100 * np.median(values)
               for values in (margin, np.abs(deviation), error, margin + allowed * error)]
    print(f"{'ok  ' if agrees else 'FAIL'} {title:24} {z.size:5} values: "
          f"beyond {percent[0]:g} % max z {z.max():.2f} (<= {allowed:.2f}), "
          f"where {100 * deviation[worst]:+.2f} % ({places[worst[0]]}); medians: "
          f"off by {percent[1]:.2f} %, noise {percent[2]:.2f} %, would fail if off by "
          f"{percent[3]:.2f} %", flush=True)
    return agrees
