"""Irradiance of texels: vlf's path tracer and its baked fields against Mitsuba 3.

Each texel is sampled at the very points of the surface that it stands for.
"""

import json
import math
import os
import subprocess

import mitsuba as mi
import numpy as np

import obj_scene
from agreement import judge, judge_margin

SCENES = ["cornell", "mirror-room", "two-rooms"]
OFFSET = 1e-4  # metres off the surface, to be on its lit side for Mitsuba's rays as well
SAMPLES_PER_PASS = 1 << 20
SMALLEST_REGION = 8  # texels
DARKEST = 0.01  # of the scene's mean: below, light is a matter of rare events, whose mean is not
# normal and whose spread is not known
# Few texels with many samples, whose mean is normal, to hold the path tracer against Mitsuba texel
# by texel; many with few, over which the noise of a bake averages out, to do so with regions of it.
FEW, MANY = 400, 6000
SAMPLES = {"cornell": 8192, "mirror-room": 12288, "two-rooms": 16384}
FEWER = 4  # times less samples for the many
# What a field of the preset "standard" may be off, relatively: in a region, in one with less than
# a tenth of the scene's mean irradiance, and in all.
REGION_MARGIN, DARK_MARGIN, SCENE_MARGIN = 0.01, 0.03, 0.002


def bake(vlf, obj):
    field = obj[:-len(".obj")] + ".vlf"
    subprocess.run([vlf, "bake", obj, "-o", field, "--preset", "standard", "--radiance-directions",
                    "0", "-q"], check=True)
    return field


def measured_texels(vlf, obj, field, texels, samples):
    """What `vlf reference` says of texels of a field: those of flat surfaces that lie wholly in
    the open, where no sample was left out."""
    report = obj[:-len(".obj")] + ".json"
    subprocess.run([vlf, "reference", obj, "--irradiance", field, "--texels", str(texels), "--spp",
                    str(samples), "--texel-points", "-o", report, "-q"], check=True)
    with open(report) as file:
        return [t for t in json.load(file)["texels"] if t["flat"] and t["samples"] == samples]


def column(texels, key):
    return np.array([t[key] for t in texels], dtype=np.float64)


class Surface:
    """Points and normals of texels, for sampling them uniformly."""

    def __init__(self, texels):
        counts = [len(t["points"]) for t in texels]
        first = np.concatenate([[0], np.cumsum(counts)[:-1]])
        points = np.concatenate([np.array(t["points"]) for t in texels])
        normals = column(texels, "normal")
        points = points + OFFSET * np.repeat(normals, counts, axis=0)
        self.count = len(texels)
        self.first, self.counts = mi.UInt32(first), mi.UInt32(np.array(counts))
        self.points = mi.Float(points.astype(np.float32).ravel())
        self.normals = mi.Float(normals.astype(np.float32).ravel())

    def interaction(self, texel, random):
        import drjit as dr
        counts = dr.gather(mi.UInt32, self.counts, texel)
        chosen = dr.minimum(mi.UInt32(random * mi.Float(counts)), counts - 1)
        si = dr.zeros(mi.SurfaceInteraction3f, dr.width(texel))
        si.p = dr.gather(mi.Point3f, self.points, dr.gather(mi.UInt32, self.first, texel) + chosen)
        si.n = dr.gather(mi.Normal3f, self.normals, texel)
        si.sh_frame, si.t = mi.Frame3f(si.n), mi.Float(1)
        return si


def irradiance_samples(scene, si, sampler):
    """The emitters by next-event estimation, all other light by a path in a cosine-distributed
    direction, less what the first hit emits."""
    import drjit as dr
    light, radiance = scene.sample_emitter_direction(si, sampler.next_2d(), True)
    direct = radiance * dr.maximum(dr.dot(light.d, si.n), 0)
    d = si.sh_frame.to_world(mi.warp.square_to_cosine_hemisphere(sampler.next_2d()))
    ray = mi.RayDifferential3f(si.spawn_ray(d))
    incident = scene.integrator().sample(scene, sampler, ray)[0]
    hit = scene.ray_intersect(ray)
    return direct + dr.pi * (incident - hit.emitter(scene).eval(hit))


def mitsuba_irradiance(scene, texels, samples):
    """Mean and standard error, (texels, 3) each."""
    import drjit as dr
    surface = Surface(texels)
    per_pass = max(1, SAMPLES_PER_PASS // surface.count)
    passes = math.ceil(samples / per_pass)
    total, squares = np.zeros((2, surface.count, 3))
    for seed in range(passes):
        width = surface.count * per_pass
        sampler = mi.load_dict({"type": "independent"})
        sampler.seed(seed, width)
        si = surface.interaction(dr.arange(mi.UInt32, width) // per_pass, sampler.next_1d())
        values = np.array(irradiance_samples(scene, si, sampler), dtype=np.float64)
        values = values.T.reshape(surface.count, per_pass, 3)
        total += values.sum(axis=1)
        squares += (values**2).sum(axis=1)
    n = per_pass * passes
    mean = total / n
    return mean, np.sqrt(np.maximum(squares / n - mean**2, 0) / (n - 1))


def region_name(position, normal, middle):
    """The octant of the scene and the axis faced, such as "-x +y +z, facing -y"."""
    axis = np.abs(normal).argmax()
    signs = np.where(np.append(position > middle, normal[axis] > 0), "+", "-")
    octant = " ".join(sign + name for sign, name in zip(signs, "xyz"))
    return f"{octant}, facing {signs[3]}{'xyz'[axis]}"


def regions_of(texels):
    """Names and weights (regions, texels) by area: a region is where the texels of one octant of
    the scene face the same way."""
    position, normal, area = (column(texels, k) for k in ("position", "normal", "area"))
    middle = (position.min(axis=0) + position.max(axis=0)) / 2
    name = np.array([region_name(p, n, middle) for p, n in zip(position, normal)])
    wanted = [r for r in np.unique(name) if (name == r).sum() >= SMALLEST_REGION]
    weights = np.array([np.where(name == r, area, 0) for r in wanted])
    return wanted, weights / weights.sum(axis=1, keepdims=True)


def lit_texels(scene, texels, samples):
    """The texels that are not too dark to judge, with Mitsuba's mean and standard error."""
    mean, error = mitsuba_irradiance(scene, texels, samples)
    brightness = mean.sum(axis=1)
    lit = brightness > DARKEST * brightness.mean()
    return [t for t, keep in zip(texels, lit) if keep], mean[lit], error[lit]


def check_traced(name, texels, theirs, their_error):
    ours, our_error = column(texels, "irradiance"), column(texels, "standardError")
    _, weights = regions_of(texels)
    agrees = judge(f"{name} texels", ours, our_error, theirs, their_error)
    return agrees & judge(f"{name} regions", weights @ ours, np.sqrt(weights**2 @ our_error**2),
                          weights @ theirs, np.sqrt(weights**2 @ their_error**2))


def check_baked(name, texels, theirs, their_error):
    baked, area = column(texels, "baked"), column(texels, "area")
    places, weights = regions_of(texels)
    whole = np.atleast_2d(area / area.sum())
    dark = weights @ theirs < whole @ theirs / 10
    margins = np.where(dark, DARK_MARGIN, REGION_MARGIN)
    agrees = True
    for title, w, margin, where in ((f"{name} baked regions", weights, margins, places),
                                    (f"{name} baked, all", whole, SCENE_MARGIN, ["all"])):
        agrees &= judge_margin(title, w @ baked, w @ theirs, np.sqrt(w**2 @ their_error**2), margin,
                               where)
    return agrees


def check_scene(name, folder, vlf):
    obj = os.path.join(folder, name + ".obj")
    subprocess.run([vlf, "scene", name, "-o", folder, "-q"], check=True)
    field = bake(vlf, obj)
    description = obj_scene.load(obj, folder)
    description["integrator"] = {"type": "path", "max_depth": -1}
    scene = mi.load_dict(description)

    few = measured_texels(vlf, obj, field, FEW, SAMPLES[name])
    agrees = check_traced(name, *lit_texels(scene, few, SAMPLES[name]))
    many = measured_texels(vlf, obj, field, MANY, 64)
    return agrees & check_baked(name, *lit_texels(scene, many, SAMPLES[name] // FEWER))


def check(arguments, folder):
    names = arguments.scenes or SCENES
    return all([check_scene(name, folder, arguments.vlf) for name in names])
