"""The irradiance error of fields, with path-traced truths that are kept and used again.

Tracing the truth takes nearly all the time of a table. It depends on the scene and on where the
texels are, not on their light: fields with the same texels share one.
"""

import hashlib
import json
import math
import tempfile

from program import info, report_of, run


def _measure(vlf, scene, field, texels, spp, report, options):
    run(vlf, "-q", "reference", scene, "--irradiance", field, "--texels", texels, "--spp", spp,
        "-o", report, *options)
    return report_of(report)


class IrradianceTruth:
    """The truth of some texels of a scene at so many samples, from `cache` if it is there.

    `options` are those of `vlf reference` that say what of the texels is measured.
    """

    def __init__(self, vlf, cache, texels, spp, *options):
        self.vlf, self.cache, self.texels, self.spp = vlf, cache, texels, spp
        self.options = options
        cache.mkdir(parents=True, exist_ok=True)

    def of(self, scene, field):
        """The report of `vlf reference --irradiance` with the errors of `field`."""
        with tempfile.TemporaryDirectory() as folder:
            baked = _measure(self.vlf, scene, field, self.texels, 1, f"{folder}/baked.json",
                             self.options)
        places = [(t["position"], t["normal"]) for t in baked["texels"]]
        scene_hash = info(self.vlf, field)["bake"]["sceneHash"]
        key = hashlib.sha256(json.dumps([scene_hash, places, *self.options]).encode()).hexdigest()
        path = self.cache / f"{scene.stem}-{self.spp}-{key[:16]}.json"
        if not path.exists():
            _measure(self.vlf, scene, field, self.texels, self.spp, path, self.options)
        return _with_errors(report_of(path), baked["texels"])


def measured_rmse(error):
    """The relative RMSE and False or, where the truth's noise hides it, a bound and True."""
    rmse, bound = error["relativeRmse"], error["relativeRmseBound"]
    hidden = bound > math.sqrt(2) * rmse  # the square error is less than two of its standard errors
    return (bound if hidden else rmse), hidden


def restricted(error, where):
    """The errors over those texels only for whose position `where` is true."""
    texels = [t for t in error["texels"] if where(t["position"])]
    return _with_errors({**error, "texels": texels}, texels)


def _with_errors(truth, baked):
    """The errors as in src/vlf/render/cpu/irradiance_error.h, for baked values of another field.

    "relativeRmseBound" is that of the mean square error and twice its standard error.
    """
    truth_squares = variance = difference = difference_variance = total = 0.0
    excess = []  # of the texels' square errors over the variance of their truth
    for texel, other in zip(truth["texels"], baked):
        if texel["samples"] < 2:
            continue
        area = texel["area"]
        excess.append(0.0)
        for b, t, s in zip(other["baked"], texel["irradiance"], texel["standardError"]):
            excess[-1] += area * ((b - t) ** 2 - s * s)
            truth_squares += area * t * t
            variance += area * s * s
            difference += area * (b - t)
            difference_variance += (area * s) ** 2
            total += area * t
    signal = truth_squares - variance
    texels = [{**t, "baked": other["baked"]} for t, other in zip(truth["texels"], baked)]
    square = max(0.0, sum(excess))
    uncertainty = math.sqrt(sum(e * e for e in excess))
    return {**truth, "texels": texels, "relativeRmse": math.sqrt(square / signal),
            "relativeRmseBound": math.sqrt((square + 2 * uncertainty) / signal),
            "truthError": math.sqrt(variance / signal), "bias": difference / total,
            "biasError": math.sqrt(difference_variance) / total}
