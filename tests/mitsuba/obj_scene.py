"""Reads what `vlf scene` writes (OBJ, MTL, cameras) and makes a Mitsuba 3 scene of it.

Materials reflect Kd diffusely and Ks as a mirror, on both sides: with illum 3 a perfect one, with
illum 2 and Pr one of that perceptual roughness. Ke is radiance that leaves the side of the winding
normal. Maps multiply their colour. illum 7 is glass of index Ni and filter Tf: refracting where the
triangles of a material enclose a solid, else a thin pane.
"""

import json
import os
from dataclasses import dataclass, field

import mitsuba as mi
import numpy as np


@dataclass
class Texture:
    path: str
    clamp: bool


@dataclass
class Material:
    colours: dict = field(default_factory=dict)  # "Kd" -> [r, g, b]
    maps: dict = field(default_factory=dict)  # "Kd" -> Texture
    illum: int = 1
    roughness: float = 0.0  # Pr
    ior: float = 1.5  # Ni

    def colour(self, key):
        return np.array(self.colours.get(key, [0.0, 0.0, 0.0]))


def read_materials(path):
    materials, current = {}, None
    folder = os.path.dirname(path)
    with open(path) as lines:
        for words in (line.split() for line in lines if line.strip()):
            if words[0] == "newmtl":
                current = materials.setdefault(words[1], Material())
            elif words[0] == "illum":
                current.illum = int(words[1])
            elif words[0] == "Pr":
                current.roughness = float(words[1])
            elif words[0] == "Ni":
                current.ior = float(words[1])
            elif words[0] in ("Kd", "Ks", "Ke", "Tf"):
                current.colours[words[0]] = [float(w) for w in words[1:4]]
            elif words[0].startswith("map_"):
                clamp = words[1:3] == ["-clamp", "on"]
                current.maps[words[0][4:]] = Texture(os.path.join(folder, words[-1]), clamp)
    return materials


def read_mesh(path):
    """Vertices (n, 8: position, normal, uv) and triangles per material of an OBJ by `vlf scene`."""
    table = {"v": [], "vn": [], "vt": []}
    faces, material, library = {}, None, None
    with open(path) as lines:
        for words in (line.split() for line in lines if line.strip()):
            if words[0] in table:
                table[words[0]].append([float(w) for w in words[1:4]])
            elif words[0] == "mtllib":
                library = os.path.join(os.path.dirname(path), words[1])
            elif words[0] == "usemtl":
                material = words[1]
            elif words[0] == "f":
                corners = [w.split("/") for w in words[1:]]
                if len(corners) != 3 or any(len(set(c)) != 1 for c in corners):
                    raise ValueError(f"{path}: not an OBJ as `vlf scene` writes it")
                faces.setdefault(material, []).append([int(c[0]) - 1 for c in corners])
    uvs = np.array(table["vt"])[:, :2]
    vertices = np.hstack([np.array(table["v"]), np.array(table["vn"]), uvs])
    return vertices, {m: np.array(f) for m, f in faces.items()}, library


def textured(material, key, factor=1.0):
    colour, texture = factor * material.colour(key), material.maps.get(key)
    if texture is None:
        return {"type": "rgb", "value": colour.tolist()}
    bitmap = mi.Bitmap(texture.path).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32, False)
    pixels = np.array(bitmap) * colour.astype(np.float32)
    wrap = "clamp" if texture.clamp else "repeat"
    return {"type": "bitmap", "bitmap": mi.Bitmap(pixels), "raw": True, "wrap_mode": wrap}


def define_diffuse_mirror():
    """Registers the BSDF "diffusemirror": Kd / pi plus a mirror of Ks, on both sides. Needed since
    Mitsuba's own blend of a smooth and a mirror BSDF weighs the mirror wrongly (3.9.1: a blend of
    0.3 x 0.5 and 0.7 x 0.9 reflects 0.749, not 0.78)."""
    import drjit as dr

    class DiffuseMirror(mi.BSDF):
        def __init__(self, props):
            mi.BSDF.__init__(self, props)
            self.diffuse = props.get_texture("diffuse")
            self.mirror = props.get_texture("mirror")
            self.chance = props["chance"]  # with which a sample is diffuse
            both = mi.BSDFFlags.FrontSide | mi.BSDFFlags.BackSide
            self.m_components = [mi.BSDFFlags.DiffuseReflection | both,
                                 mi.BSDFFlags.DeltaReflection | both]
            self.m_flags = self.m_components[0] | self.m_components[1]

        def cosine(self, si, wo):
            same_side = mi.Frame3f.cos_theta(si.wi) * mi.Frame3f.cos_theta(wo) > 0
            return dr.select(same_side, dr.abs(mi.Frame3f.cos_theta(wo)), 0)

        def sample(self, ctx, si, sample1, sample2, active=True):
            is_diffuse = sample1 < self.chance
            wo = mi.warp.square_to_cosine_hemisphere(sample2)
            wo.z *= dr.sign(mi.Frame3f.cos_theta(si.wi))
            bs = mi.BSDFSample3f()
            bs.wo = dr.select(is_diffuse, wo, mi.reflect(si.wi))
            bs.pdf = dr.select(is_diffuse, self.pdf(ctx, si, wo), 1 - self.chance)
            bs.eta = 1.0
            bs.sampled_type = dr.select(is_diffuse, +mi.BSDFFlags.DiffuseReflection,
                                        +mi.BSDFFlags.DeltaReflection)
            bs.sampled_component = dr.select(is_diffuse, mi.UInt32(0), mi.UInt32(1))
            weight = dr.select(is_diffuse, self.diffuse.eval(si) / max(self.chance, 1e-30),
                               self.mirror.eval(si) / max(1 - self.chance, 1e-30))
            return bs, weight & active

        def eval(self, ctx, si, wo, active=True):
            return (self.diffuse.eval(si) * self.cosine(si, wo) / dr.pi) & active

        def pdf(self, ctx, si, wo, active=True):
            return dr.select(active, self.chance * self.cosine(si, wo) / dr.pi, 0)

        def eval_pdf(self, ctx, si, wo, active=True):
            return self.eval(ctx, si, wo, active), self.pdf(ctx, si, wo, active)

        def to_string(self):
            return f"DiffuseMirror[chance={self.chance}]"

    mi.register_bsdf("diffusemirror", DiffuseMirror)


def rough(material):
    """Facets of a constant reflectance, blended with what is diffuse, each scaled by its share."""
    kd, ks = material.colour("Kd").max(), material.colour("Ks").max()
    share = ks / (kd + ks)
    mirror = {"type": "roughconductor", "material": "none", "distribution": "ggx",
              "alpha": material.roughness ** 2,
              "specular_reflectance": textured(material, "Ks", 1 / share)}
    if kd == 0:
        return {"type": "twosided", "bsdf": mirror}
    diffuse = {"type": "diffuse", "reflectance": textured(material, "Kd", 1 / (1 - share))}
    return {"type": "twosided", "bsdf": {"type": "blendbsdf", "weight": float(share),
                                         "diffuse": diffuse, "mirror": mirror}}


def is_closed(vertices, triangles):
    """Whether every edge, its ends told by position, is of two triangles."""
    _, place = np.unique(vertices[:, :3], axis=0, return_inverse=True)
    corners = place.reshape(-1)[triangles]
    edges = np.sort(np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]]), axis=1)
    return bool((np.unique(edges, axis=0, return_counts=True)[1] == 2).all())


def glass(material, closed):
    filter_ = material.colour("Tf")
    common = {"int_ior": material.ior, "ext_ior": 1.0}
    if not closed:
        return {"type": "thindielectric", **common,
                "specular_transmittance": {"type": "rgb", "value": filter_.tolist()}}
    return {"type": "dielectric", **common,
            "specular_transmittance": {"type": "rgb", "value": np.sqrt(filter_).tolist()}}


def bsdf(material):
    if material.illum == 2 and material.roughness > 0:
        return rough(material)
    kd = material.colour("Kd").max()
    ks = material.colour("Ks").max() if material.illum in (3, 5) else 0.0
    if ks == 0:
        diffuse = {"type": "diffuse", "reflectance": textured(material, "Kd")}
        return {"type": "twosided", "bsdf": diffuse}
    return {"type": "diffusemirror", "chance": float(kd / (kd + ks)),
            "diffuse": textured(material, "Kd"), "mirror": textured(material, "Ks")}


def write_ply(path, vertices, triangles):
    properties = "".join(f"property float {name}\n"
                         for name in ("x", "y", "z", "nx", "ny", "nz", "u", "v"))
    header = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\n{properties}"
              f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n")
    faces = np.zeros(len(triangles), dtype=[("count", "u1"), ("vertices", "<i4", 3)])
    faces["count"], faces["vertices"] = 3, triangles
    with open(path, "wb") as file:
        file.write(header.encode() + vertices.astype("<f4").tobytes() + faces.tobytes())


def shape(vertices, triangles, material, path):
    # Row 0 of a bitmap is v = 0 in Mitsuba, v = 1 in an OBJ.
    flipped = vertices * [1, 1, 1, 1, 1, 1, 1, -1] + [0, 0, 0, 0, 0, 0, 0, 1]
    used, index = np.unique(triangles, return_inverse=True)
    write_ply(path, flipped[used], index.reshape(-1, 3))
    is_glass = material.illum == 7
    result = {"type": "ply", "filename": path,
              "bsdf": glass(material, is_closed(vertices, triangles)) if is_glass else bsdf(material)}
    if material.colour("Ke").max() > 0:
        result["emitter"] = {"type": "area", "radiance": textured(material, "Ke")}
    return result


def load(obj_path, work_folder):
    """The scene's shapes, as a Mitsuba dictionary without sensor and integrator."""
    define_diffuse_mirror()
    vertices, parts, library = read_mesh(obj_path)
    materials = read_materials(library)
    scene = {"type": "scene"}
    for i, (name, triangles) in enumerate(parts.items()):
        ply = os.path.join(work_folder, f"part{i}.ply")
        scene[f"part{i}"] = shape(vertices, triangles, materials[name], ply)
    return scene


def cameras(obj_path):
    with open(os.path.splitext(obj_path)[0] + ".cameras.json") as file:
        return {c["name"]: c for c in json.load(file)["cameras"]}


def sensor(camera, width, height):
    view = mi.ScalarTransform4f().look_at(camera["eye"], camera["look"],
                                          camera.get("up", [0, 1, 0]))
    film = {"type": "hdrfilm", "width": width, "height": height, "pixel_format": "rgb",
            "component_format": "float32", "rfilter": {"type": "box"}}
    return {"type": "perspective", "fov_axis": "y", "fov": camera.get("verticalFov", 50),
            "near_clip": 1e-3, "far_clip": 1e5, "to_world": view, "film": film,
            "sampler": {"type": "independent"}}
