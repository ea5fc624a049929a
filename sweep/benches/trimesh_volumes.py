"""Checks random specs with trimesh: closed after merging vertices, and the volume of a formula.

For each kind of spec, the programs `sweep` and `triangulate` make an STL, which is read by trimesh and its vertices
merged. The mesh must be watertight, wound consistently and of the volume that a formula gives, to a thousandth.

    python3 sweep/benches/trimesh_volumes.py target/release 200
    python3 sweep/benches/trimesh_volumes.py target/release 20 cup relief

Needs trimesh (pip install trimesh). Prints one line for each kind, and each spec that fails.
"""

import json
import math
import os
import random
import subprocess
import sys
import tempfile

import trimesh

PROGRAMS = sys.argv[1] if len(sys.argv) > 1 else "target/release"
COUNT = int(sys.argv[2]) if len(sys.argv) > 2 else 200
PI = math.pi


def spec(contour, trajectory, **keys):
    base = {"format": "tb-sweep", "version": 1, "name": "a", "contour": contour, "trajectory": trajectory}
    return {**base, **keys}


BAR = {"line": [[0, 0, 0], [0, 0, 3]]}
FLAT = {"start": "flat", "end": "flat"}


def drawing(rng, folder):
    """A plate with a hole from an SVG file, moved by transforms, in millimetres."""
    w, h, r, s = rng.uniform(5, 20), rng.uniform(5, 20), rng.uniform(0.5, 2), rng.uniform(0.3, 2)
    with open(os.path.join(folder, "a.svg"), "w") as file:
        file.write(
            f"<svg width='100mm' height='50mm' viewBox='0 0 200 100'><g transform='rotate({rng.uniform(0, 360)} 50 50) "
            f"scale({s})'><rect x='9' y='9' width='{w}' height='{h}' rx='1'/><circle cx='{9 + w / 2}' cy='{9 + h / 2}' "
            f"r='{r}'/></g></svg>"
        )
    area = (w * h - (4 - PI) - PI * r * r) * s * s / 4
    return spec({"svg": {"file": "a.svg"}}, BAR, caps=FLAT, unit="mm", mesh={"tol": 1e-4}), 3 * area


def cup(rng, folder):
    """A vessel of straight sides that turn inward, with a floor. Its inner sides meet in mitres."""
    t, floor = rng.uniform(0.02, 0.12), rng.uniform(0.02, 0.3)
    points, angle = [(0.0, 0.0), (rng.uniform(1, 3), 0.0)], 25.0
    for _ in range(rng.randint(1, 3)):
        angle += rng.uniform(10, 30)
        length = rng.uniform(0.6, 2)
        x, y = points[-1]
        points.append((x + length * math.cos(math.radians(angle)), y + length * math.sin(math.radians(angle))))
    sides = []
    for i, (a, b) in enumerate(zip(points, points[1:])):
        length = math.dist(a, b)
        u = ((b[0] - a[0]) / length, (b[1] - a[1]) / length)
        d = floor if i == 0 else t
        sides.append(((a[0] - u[1] * d, a[1] + u[0] * d), u))
    inner = [(0.0, floor)]
    for (p, u), (q, v) in zip(sides, sides[1:]):
        s = ((q[0] - p[0]) * v[1] - (q[1] - p[1]) * v[0]) / (u[0] * v[1] - u[1] * v[0])
        inner.append((p[0] + u[0] * s, p[1] + u[1] * s))
    end, u = points[-1], sides[-1][1]
    inner.append((end[0] - u[1] * t, end[1] + u[0] * t))
    outline = points + inner[::-1]
    moment = sum(
        (a[0] * b[1] - a[1] * b[0]) * (a[0] + b[0]) / 6 for a, b in zip(outline, outline[1:] + outline[:1])
    )
    contour = {"polyline": {"points": points}}
    wall = {"thickness": t, "floor": floor}
    return spec(contour, {"rotation": {}}, wall=wall, mesh={"rows": 256, "cols": 40}), 2 * PI * moment


def relief(rng, folder):
    """A straight beaker with waves on its outer side that fade at the corner and at the rim."""
    radius, high, t = rng.uniform(1, 2), rng.uniform(1, 3), rng.uniform(0.2, 0.3)
    amp, waves = rng.uniform(0.02, 0.1), rng.randint(3, 9)
    fade = rng.uniform(0.1, 0.4)
    contour = {"polyline": {"points": [[0, 0], [radius, 0], [radius, high]]}}
    term = {"amp": amp, "v": waves}
    depth = {"mode": "offset", "terms": [term], "fade": fade}
    volume = PI * radius**2 * high - PI * (radius - t) ** 2 * (high - t)
    # The mean of the squared wave is a half. The sine adds nothing on the wall. On the floor it moves points along
    # the axis, and its mean is 0.
    steps = 4000
    for i in range(steps):
        y = (i + 0.5) * high / steps
        f = 1.0
        for x in (y / min(fade, high / 2), (high - y) / min(fade, high / 2)):
            if x < 1:
                f *= x * x * (3 - 2 * x)
        volume += PI * (amp * f) ** 2 / 2 * high / steps
    mesh = {"rows": 48 * waves, "cols": 200}
    return spec(contour, {"rotation": {}}, wall=t, depth=depth, mesh=mesh), volume


def table(rng, folder):
    """A rod through the points of a table, with a radius at each."""
    x, last, volume = 0.0, None, 0.0
    with open(os.path.join(folder, "a.csv"), "w") as file:
        file.write("r,x,y,z\n")
        for _ in range(rng.randint(2, 10)):
            r = rng.uniform(0.3, 1)
            if last is not None:
                step = rng.uniform(0.5, 3)
                x += step
                volume += PI / 3 * step * 1.5 * (last * last + last * r + r * r)
            file.write(f"{r},{x},{0.5 * x},{-x}\n")
            last = r
    line = {"polyline": {"csv": {"file": "a.csv", "radius": "r"}}}
    return spec({"circle": 1}, line, caps=FLAT, mesh={"tol": 2e-4}), volume


def fitted(rng, folder):
    """A tube along noisy points of an arc. Its volume is the area of the section times the length of the arc.

    A fit that is off by 0.002 on one side changes the length by half a thousandth at most; noise averages to less.
    """
    radius, turn = rng.uniform(4, 8), rng.uniform(1, 4)
    points = []
    for i in range(121):
        # The ends stay, because noise along the arc would change its length.
        noise = lambda: rng.uniform(-0.001, 0.001) if 0 < i < 120 else 0.0
        a = turn * i / 120
        points.append([radius * math.cos(a) + noise(), radius * math.sin(a) + noise(), noise()])
    line = {"free": {"points": points, "fit": 0.002}}
    return spec({"circle": 0.5}, line, caps=FLAT, mesh={"tol": 1e-4}), PI / 4 * radius * turn


def neurites(rng, folder):
    """A sphere, and straight tubes with half spheres at their ends that start in each other."""
    soma, r, thin = rng.uniform(3, 5), rng.uniform(1, 1.5), rng.uniform(0.4, 0.9)
    a, b, c = rng.uniform(6, 9), rng.uniform(3, 6), rng.uniform(3, 6)
    with open(os.path.join(folder, "a.swc"), "w") as file:
        file.write(
            f"1 1 0 0 0 {soma} -1\n2 3 {a} 0 0 {r} 1\n3 3 {a + b} 0 0 {r} 2\n4 3 {a} {c} 0 {thin} 2\n"
        )
    tube = lambda length, r: PI * r * r * length + 4 / 3 * PI * r**3
    volume = 4 / 3 * PI * soma**3 + tube(a + b, r) + tube(c, thin)
    return spec({"circle": 1}, {"swc": {"file": "a.swc"}}, mesh={"tol": 5e-4}), volume


def copies(rng, folder):
    """Copies of a cone, turned and enlarged."""
    count, s, r, high = rng.randint(1, 5), rng.uniform(0.5, 2), rng.uniform(0.5, 1), rng.uniform(1, 2)
    place = [{"rotate_deg": {"axis": [1, rng.uniform(-1, 1), 2], "angle": rng.uniform(0, 360)}}, {"scale": s}]
    step = [{"translate": [20, 1, 0]}]
    contour = {"polyline": {"points": [[0, 0], [r, 0], [0, high]]}}
    own = spec(contour, {"rotation": {}}, place=place, copies={"count": count, "step": step}, mesh={"tol": 2e-5})
    return own, count * s**3 * PI / 3 * r * r * high


def thread(rng, folder):
    """A square bar along a helix of either hand, turned away from its axis."""
    radius, rise, turns = rng.uniform(2, 5), rng.uniform(1, 2), rng.choice([-1, 1]) * rng.uniform(1, 3)
    half = rng.uniform(0.1, 0.3)
    square = {"polyline": {"closed": True, "points": [[half, half], [-half, half], [-half, -half], [half, -half]]}}
    line = {"helix": {"radius": radius, "rise": rise, "turns": turns}}
    length = abs(turns) * math.hypot(2 * PI * radius, rise)
    own = spec(square, line, frame={"away": {"axis": [0, 1, 0]}}, caps=FLAT, mesh={"tol": 5e-5})
    return own, 4 * half * half * length


def grip(rng, folder):
    """A straight tube with a wall on any side, scaled evenly along it, with waves on its outer side."""
    r, t, high = rng.uniform(1, 2), rng.uniform(0.2, 0.4), rng.uniform(1, 4)
    amp, waves, end = rng.uniform(0.02, 0.1), rng.randint(3, 9), rng.uniform(0.7, 1.4)
    side = rng.choice(["inward", "outward", "center"])
    outer = {"inward": 0, "outward": t, "center": t / 2}[side]
    area = lambda s: PI * ((s * r + outer) ** 2 + (s * amp) ** 2 / 2 - (s * r + outer - t) ** 2)
    volume = high / 6 * (area(1) + 4 * area((1 + end) / 2) + area(end))
    depth = {"mode": "offset", "terms": [{"amp": amp, "u": waves, "v": rng.randint(0, 3)}]}
    line = {"line": [[0, 0, 0], [0, high, 0]]}
    wall = {"thickness": t, "side": side}
    scale = {"keys": [[0, 1], [1, end]]}
    mesh = {"rows": 64, "cols": 64 * waves}
    return spec({"circle": r}, line, wall=wall, depth=depth, scale=scale, mesh=mesh), volume


def letter(rng, folder):
    """An SVG path of squares inside each other in random directions, with a random fill rule and a mirror."""
    halves = sorted((rng.uniform(1, 20) for _ in range(rng.randint(1, 5))), reverse=True)
    for i in range(1, len(halves)):
        halves[i] = min(halves[i], 0.9 * halves[i - 1])
    turns = [rng.choice([-1, 1]) for _ in halves]
    even = rng.choice([False, True])
    one = lambda a, turn: f"M-{a} -{a}" + (f"H{a}V{a}H-{a}" if turn > 0 else f"V{a}H{a}V-{a}") + "Z"
    path = "".join(one(a, turn) for a, turn in zip(halves, turns))
    rule = "style='fill-rule:evenodd'" if even else rng.choice(["", "fill-rule='nonzero'"])
    mirror = rng.choice(["scale(-1 1)", "matrix(0 1 1 0 3 4)", f"rotate({rng.uniform(0, 360)})"])
    with open(os.path.join(folder, "a.svg"), "w") as file:
        file.write(f"<svg viewBox='-50 -50 100 100'><g {rule}><path d='{path}' transform='{mirror}'/></g></svg>")
    area, winding = 0.0, 0
    for i, (a, turn) in enumerate(zip(halves, turns)):
        winding += turn
        filled = winding % 2 if even else winding != 0
        inner = halves[i + 1] if i + 1 < len(halves) else 0
        area += 4 * (a * a - inner * inner) * bool(filled)
    return spec({"svg": {"file": "a.svg"}}, BAR, caps=FLAT, mesh={"tol": 1e-3}), 3 * area


def formula(rng, folder):
    """A tube along a torus knot by formula. Its volume is the area of the section times the length."""
    p, q = rng.choice([(2, 3), (3, 2), (2, 5), (3, 4), (3, 5)])
    big, small, r = rng.uniform(3, 5), rng.uniform(1, 1.5), rng.uniform(0.1, 0.25)
    rho = f"({big} + {small} * cos({q} * t))"
    line = {"formula": {"x": f"{rho} * cos({p} * t)", "y": f"{rho} * sin({p} * t)", "z": f"{small} * sin({q} * t)",
                        "t": [0, 2 * PI], "closed": True}}
    steps = 20000
    speed = lambda t: math.hypot(p * (big + small * math.cos(q * t)), small * q)
    length = sum(speed(2 * PI * (i + 0.5) / steps) for i in range(steps)) * 2 * PI / steps
    return spec({"circle": r}, line, mesh={"tol": 1e-4 * r}), PI * r * r * length


def made(own, folder):
    path = os.path.join(folder, "a.json")
    with open(path, "w") as file:
        json.dump(own, file)
    stl = os.path.join(folder, "a.stl")
    grid = subprocess.run([f"{PROGRAMS}/sweep", "-q", path], capture_output=True, check=True).stdout
    subprocess.run([f"{PROGRAMS}/triangulate", "-q", "-", "-o", stl], input=grid, check=True)
    return trimesh.load(stl)


def main():
    failed = 0
    kinds = (drawing, cup, relief, table, fitted, neurites, copies, thread, grip, letter, formula)
    for kind in kinds:
        if len(sys.argv) > 3 and kind.__name__ not in sys.argv[3:]:
            continue
        rng = random.Random(kind.__name__)
        good, worst = 0, 0.0
        for _ in range(COUNT):
            with tempfile.TemporaryDirectory() as folder:
                own, volume = kind(rng, folder)
                mesh = made(own, folder)
            off = abs(mesh.volume / volume - 1)
            worst = max(worst, off)
            if mesh.is_volume and off < 1e-3:
                good += 1
            else:
                print(f"  {kind.__name__}: is_volume {mesh.is_volume}, off by {off:.2e}: {json.dumps(own)[:600]}")
        failed += COUNT - good
        print(f"{kind.__name__:10} {good} of {COUNT}, volumes within {worst:.1e}")
    sys.exit(1 if failed else 0)


main()
