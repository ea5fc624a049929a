#!/usr/bin/env python3
"""Compares the silhouettes of meshes that other programs wrote with those of a second reader, trimesh.

    compare.py RENDER FOLDER... [--list FILE.tsv]

Each mesh file below the folders is rendered in white on black and projected a second time from the
triangles that trimesh reads. A pixel counts as different if it is covered wholly in one picture and not at
all, neighbours included, in the other. Prints one line for each file, and the sums.

Needs Python 3 with trimesh, numpy, scipy, Pillow, networkx, lxml and charset-normalizer, all by pip.
"""

import argparse
import json
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy
import trimesh
from PIL import Image

ENDINGS = {".obj", ".stl", ".ply", ".glb", ".gltf"}
SIZE = 96
FOV_DEG = 30.0
# Of the pixels that either picture covers. Files of this test have at most some hundred such pixels, and
# polygons that are divided along another diagonal differ in single ones.
MOST_DIFFERENT = 0.01
DIRECTION = numpy.array([0.5, 0.35, 0.8]) / numpy.linalg.norm([0.5, 0.35, 0.8])


def absolute(path, folder):
    """Returns a copy of an OBJ whose indices count from the first vertex. trimesh takes a negative index
    from the last vertex of the file, and not from the last one before the face."""
    text = path.read_bytes()
    if not re.search(rb"^f\s.*-\d", text, re.M):
        return path
    counts, lines = [0, 0, 0], []
    for line in text.splitlines():
        words = line.split()
        if words and words[0] in (b"v", b"vt", b"vn"):
            counts[(b"v", b"vt", b"vn").index(words[0])] += 1
        if words and words[0] == b"f":
            corners = [corner.split(b"/") for corner in words[1:]]
            for corner in corners:
                for k, part in enumerate(corner):
                    if part.startswith(b"-"):
                        corner[k] = b"%d" % (counts[k] + 1 + int(part))
            line = b"f " + b" ".join(b"/".join(corner) for corner in corners)
        lines.append(line)
    (folder / path.name).write_bytes(b"\n".join(lines) + b"\n")
    return folder / path.name


def read(path):
    """Returns the corners of all triangles, (n, 3, 3), as trimesh reads them."""
    with tempfile.TemporaryDirectory() as folder:
        second = absolute(path, pathlib.Path(folder)) if path.suffix.lower() == ".obj" else path
        scene = trimesh.load_scene(str(second), process=False)
    meshes = [m for m in scene.dump() if isinstance(m, trimesh.Trimesh) and len(m.faces)]
    if not meshes:
        return numpy.zeros((0, 3, 3))
    corners = [numpy.asarray(m.vertices, float)[m.faces] for m in meshes]
    return numpy.concatenate(corners)


def camera(corners):
    """Returns eye and target of a camera that sees all corners."""
    low, high = corners.min((0, 1)), corners.max((0, 1))
    middle, radius = (low + high) / 2, numpy.linalg.norm(high - low) / 2
    radius = max(radius, 1e-6 * (1 + abs(middle).max()))
    return middle + DIRECTION * 1.1 * radius / numpy.sin(numpy.radians(FOV_DEG / 2)), middle


def covered(corners, eye, target):
    """Returns the pixels whose centres the triangles cover."""
    back = (eye - target) / numpy.linalg.norm(eye - target)
    right = numpy.cross([0.0, 1.0, 0.0], back)
    right /= numpy.linalg.norm(right)
    up = numpy.cross(back, right)
    seen = (corners - eye) @ numpy.array([right, up, back]).T
    scale = SIZE / 2 / numpy.tan(numpy.radians(FOV_DEG / 2))
    x = SIZE / 2 + scale * seen[..., 0] / -seen[..., 2]
    y = SIZE / 2 - scale * seen[..., 1] / -seen[..., 2]
    mask = numpy.zeros((SIZE, SIZE), bool)
    low = numpy.clip(numpy.floor(numpy.stack([x.min(1), y.min(1)], 1) - 0.5), 0, SIZE).astype(int)
    high = numpy.clip(numpy.ceil(numpy.stack([x.max(1), y.max(1)], 1) + 0.5), 0, SIZE).astype(int)
    for k in range(len(corners)):
        (x0, y0), (x1, y1) = low[k], high[k]
        if x1 <= x0 or y1 <= y0 or mask[y0:y1, x0:x1].all():
            continue
        px, py = numpy.meshgrid(numpy.arange(x0, x1) + 0.5, numpy.arange(y0, y1) + 0.5)
        sides = [
            (x[k, j] - x[k, i]) * (py - y[k, i]) - (y[k, j] - y[k, i]) * (px - x[k, i])
            for i, j in ((0, 1), (1, 2), (2, 0))
        ]
        inside = (numpy.minimum.reduce(sides) >= 0) | (numpy.maximum.reduce(sides) <= 0)
        mask[y0:y1, x0:x1] |= inside
    return mask


def near(mask):
    """Returns the pixels of a mask and their neighbours."""
    padded = numpy.pad(mask, 1)
    parts = [padded[j : j + SIZE, i : i + SIZE] for j in range(3) for i in range(3)]
    return numpy.logical_or.reduce(parts)


def rendered(render, path, eye, target):
    """Renders the file. Returns the pixels with light, and the words on standard error."""
    scene = {
        "format": "tb-scene", "version": 1, "ambient": 1, "background": 0, "max_depth": 0,
        "camera": {"eye": list(eye), "target": list(target), "fov_deg": FOV_DEG},
        "materials": {"white": {"color": 1, "ambient": 1, "diffuse": 0}},
        "objects": [{"mesh": {"name": "read", "file": str(path.resolve()), "material": "white"}}],
    }
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        (folder / "scene.json").write_text(json.dumps(scene))
        command = [render, folder / "scene.json", "-o", folder / "out.png", "--size", f"{SIZE}x{SIZE}"]
        run = subprocess.run(command, capture_output=True, timeout=300)
        said = run.stderr.decode("utf-8", "replace").strip()
        if run.returncode != 0:
            return None, said
        return numpy.asarray(Image.open(folder / "out.png").convert("L")), said


def compared(render, path):
    """Returns the result for a file: a word, a number of pixels, and a sentence."""
    second, fault = None, ""
    try:
        second = read(path)
        finite = numpy.isfinite(second).all((1, 2))
        second = second[finite]
    except Exception as error:  # noqa: BLE001 - any failure of the second reader is a result
        fault = f"{type(error).__name__}: {error}".split("\n")[0][:120]
    if second is None or len(second) == 0:
        image, said = rendered(render, path, numpy.array([3.0, 2.0, 5.0]), numpy.zeros(3))
        words = "no triangles" if second is not None else fault
        return ("refused" if image is None else "alone"), 0, f"trimesh: {words}; {said}"
    eye, target = camera(second)
    image, said = rendered(render, path, eye, target)
    if image is None:
        return "refused", 0, said
    ours, theirs = image > 0, covered(second, eye, target)
    full = image > 250
    different = (full & ~near(theirs)) | (theirs & ~near(ours))
    union = max((ours | theirs).sum(), 1)
    word = "agrees" if different.sum() <= MOST_DIFFERENT * union else "differs"
    return word, int(different.sum()), said


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("render")
    parser.add_argument("folders", nargs="+", type=pathlib.Path)
    parser.add_argument("--list", type=pathlib.Path, help="a file for one line for each mesh")
    arguments = parser.parse_args()
    lines, sums = [], {}
    for folder in arguments.folders:
        for path in sorted(p for p in folder.rglob("*") if p.suffix.lower() in ENDINGS and p.is_file()):
            word, pixels, said = compared(arguments.render, path)
            said = re.sub(r"\s+", " ", said.replace(str(path.resolve()), path.name))
            line = f"{folder.name}\t{path.relative_to(folder)}\t{word}\t{pixels}\t{said[:400]}"
            print(line, flush=True)
            lines.append(line)
            key = (folder.name, path.suffix.lower())
            counts = sums.setdefault(key, dict.fromkeys(("agrees", "alone", "differs", "refused"), 0))
            counts[word] += 1
    print("\ncollection\tformat\tagrees\talone\tdiffers\trefused")
    for (name, suffix), counts in sorted(sums.items()):
        print(f"{name}\t{suffix}\t" + "\t".join(str(counts[word]) for word in sorted(counts)))
    if arguments.list:
        arguments.list.write_text("\n".join(lines) + "\n")
    return 1 if any(counts["differs"] for counts in sums.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
