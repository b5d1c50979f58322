#!/usr/bin/env python3
"""A picture by Mitsuba 3, which shares no code with this project: what the light must be, and what it costs elsewhere.

    pip install mitsuba==3.9.1 numpy
    python3 scripts/pathtracer.py scenes/cornell.obj -o reference.exr --passes 64 --samples 64 --se se.exr
    python3 scripts/pathtracer.py scenes/cornell.obj -o equal.exr --seconds 12

Variant of rgb, lamps as meshes, box filter, no limit of depth, EXR of single precision: otherwise it computes other light.
Prints processor seconds (without loading and compiling), samples per pixel, and relMSE of the picture by its own passes.
"""
import argparse
import os
import sys
import tempfile
import time
import tomllib


def options():
    parser = argparse.ArgumentParser(description="A picture by Mitsuba 3.")
    parser.add_argument("scene", help="OBJ file with MTL and camera file beside it, as pm-scene writes them")
    parser.add_argument("-o", "--output", required=True, metavar="FILE.exr")
    parser.add_argument("--se", metavar="FILE.exr", help="standard error of each pixel, from the passes")
    parser.add_argument("--size", type=int, default=128, metavar="PIXELS", help="across and down")
    parser.add_argument("--crop", metavar="X0,Y0,X1,Y1", help="these pixels alone")
    parser.add_argument("--samples", type=int, default=16, help="samples per pixel of a pass")
    parser.add_argument("--passes", type=int, default=4)
    parser.add_argument("--seconds", type=float, help="as many passes as fit into so much processor time, instead")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--variant", default="scalar_rgb")
    parser.add_argument("--threads", type=int, default=2, help="at least 2: with one Mitsuba 3.9.1 waits for ever")
    return parser.parse_args()


def read_mtl(path):
    """Materials by name: Kd, Ks, Ke as lists, Ni as a number, illum."""
    materials = {}
    for words in (line.split() for line in open(path, encoding="utf-8")):
        if not words or words[0].startswith("#"):
            continue
        if words[0] == "newmtl":
            current = materials.setdefault(words[1], {})
        elif words[0] in ("Kd", "Ks", "Ke", "Tf"):
            current[words[0]] = [float(word) for word in words[1:4]]
        elif words[0] in ("Ni", "illum"):
            current[words[0]] = float(words[1])
    return materials


def at(word, things):
    """The place that a number of an OBJ file means: from 1, or from the last backwards."""
    number = int(word)
    return number - 1 if number > 0 else len(things) + number


def read_obj(path):
    """Positions, normals, materials, and the triangles of each material, flat ones apart from smooth ones."""
    points, normals, materials, faces, current = [], [], {}, {}, None
    for words in (line.split() for line in open(path, encoding="utf-8")):
        if not words:
            continue
        if words[0] == "v":
            points.append([float(word) for word in words[1:4]])
        elif words[0] == "vn":
            normals.append([float(word) for word in words[1:4]])
        elif words[0] == "mtllib":
            materials = read_mtl(os.path.join(os.path.dirname(path), words[1]))
        elif words[0] == "usemtl":
            current = words[1]
        elif words[0] == "f":
            corners = [(word.split("/") + ["", ""])[:3] for word in words[1:]]
            smooth = all(corner[2] for corner in corners)
            corners = [(at(point, points), at(normal, normals) if smooth else 0) for point, _, normal in corners]
            for b, c in zip(corners[1:], corners[2:]):  # the scenes' polygons are convex
                faces.setdefault((current, smooth), []).append((corners[0], b, c))
    return points, normals, materials, faces


def bsdf(material):
    """The same surface in Mitsuba's words."""
    rgb = lambda value: {"type": "rgb", "value": value}
    kd, ks = material.get("Kd", [0.5] * 3), material.get("Ks", [0.0] * 3)
    if material.get("illum") in (6.0, 7.0):
        return {"type": "dielectric", "int_ior": material["Ni"], "ext_ior": 1.0,
                "specular_transmittance": rgb(material.get("Tf", [1.0] * 3))}
    diffuse = lambda share: {"type": "diffuse", "reflectance": rgb([value / share for value in kd])}
    mirror = lambda share: {"type": "conductor", "material": "none",
                            "specular_reflectance": rgb([value / share for value in ks])}
    if material.get("illum") not in (3.0, 5.0) or max(ks) == 0.0:
        inner = diffuse(1.0)
    elif max(kd) == 0.0:
        inner = mirror(1.0)
    else:
        share = max(ks) / (max(ks) + max(kd))
        inner = {"type": "blendbsdf", "weight": share, "first": diffuse(1.0 - share), "second": mirror(share)}
    return {"type": "twosided", "nested": inner}


def load(mi, np, path, size, crop, folder):
    points, normals, materials, faces = read_obj(path)
    points, normals = np.array(points, np.float32), np.array(normals, np.float32).reshape(-1, 3)
    with open(os.path.splitext(path)[0] + ".camera.toml", "rb") as file:
        camera = tomllib.load(file)
    scene = {
        "type": "scene",
        "integrator": {"type": "path", "max_depth": -1, "rr_depth": 8},
        "sensor": {
            "type": "perspective", "fov": camera["vfov"], "fov_axis": "y",
            "to_world": mi.ScalarTransform4f().look_at(camera["eye"], camera["look_at"], camera["up"]),
            "film": {"type": "hdrfilm", "width": size, "height": size, "crop_offset_x": crop[0],
                     "crop_offset_y": crop[1], "crop_width": crop[2] - crop[0], "crop_height": crop[3] - crop[1], "pixel_format": "rgb",
                     "component_format": "float32", "rfilter": {"type": "box"}},
            "sampler": {"type": "independent", "sample_count": 16},
        },
    }
    for number, ((name, smooth), triangles) in enumerate(faces.items()):
        pairs = np.array(triangles).reshape(-1, 2)
        unique, index = np.unique(pairs, axis=0, return_inverse=True)
        mesh = mi.Mesh("mesh", len(unique), len(triangles), has_vertex_normals=smooth)
        arrays = mi.traverse(mesh)
        arrays["vertex_positions"] = points[unique[:, 0]].ravel()
        if smooth:
            arrays["vertex_normals"] = normals[unique[:, 1]].ravel()
        arrays["faces"] = index.ravel().astype(np.uint32)
        arrays.update()
        file = os.path.join(folder, f"{number}.ply")
        mesh.write_ply(file)
        shape = {"type": "ply", "filename": file, "face_normals": not smooth, "bsdf": bsdf(materials[name])}
        if max(materials[name].get("Ke", [0.0])) > 0.0:
            shape["emitter"] = {"type": "area", "radiance": {"type": "rgb", "value": materials[name]["Ke"]}}
        scene[f"mesh{number}"] = shape
    return mi.load_dict(scene)


def main():
    asked = options()
    import drjit
    import mitsuba as mi
    import numpy as np

    mi.set_variant(asked.variant)
    drjit.set_thread_count(asked.threads)
    with tempfile.TemporaryDirectory() as folder:
        crop = [int(at) for at in asked.crop.split(",")] if asked.crop else [0, 0, asked.size, asked.size]
        scene = load(mi, np, asked.scene, asked.size, crop, folder)
        render = lambda seed: np.array(mi.render(scene, spp=asked.samples, seed=seed), np.float64)
        render(2**31)  # compiles
        total, squares, passes, start = 0.0, 0.0, 0, time.process_time()
        while passes < asked.passes if asked.seconds is None else time.process_time() - start < asked.seconds:
            picture = render(asked.seed * 4096 + passes)
            total, squares, passes = total + picture, squares + picture**2, passes + 1
        seconds = time.process_time() - start
    mean = total / passes
    error = np.sqrt(np.maximum(squares / passes - mean**2, 0.0) / max(passes - 1, 1))
    for path, picture in ((asked.output, mean), (asked.se, error)):
        if path:
            bitmap = mi.Bitmap(picture.astype(np.float32), mi.Bitmap.PixelFormat.RGB)
            bitmap.write(path)
    rel = np.mean(error**2 / (mean**2 + 1e-2 * np.mean(mean) ** 2))
    print(f"seconds,samples,rel_mse\n{seconds:.2f},{passes * asked.samples},{rel:.3g}")


if __name__ == "__main__":
    sys.exit(main())
