"""evenly beside other remeshers from PyPI: the same numbers of vertices, one thread, one process a mesh.

python benches/python/remeshers.py --evenly target/release/evenly -n 8500 a.off b.obj

Needs evenly's command, numpy, meshio, pyacvd, pymeshlab and gpytoolbox; prints the tables of docs/python/remeshers.md. Rivals that are not installed are left out.
"""

import argparse
import importlib.util
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

RUNS = 3
"""The least time of so many counts."""
TRIES = 6
"""So many edge lengths are tried at most, for as many vertices as asked for."""
PATIENCE = 600
"""Seconds after which a rival is given up."""
CREASE = 40
"""Degrees from which on evenly keeps an edge, if it is not told otherwise."""
ONE_THREAD = {name: "1" for name in ["OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS", "VTK_SMP_MAX_THREADS"]}
HEADER = ["", "vertices", "time", "tries", "angles", "obtuse", "Q_min", "Q_avg", "V567", "RMS", "Hausdorff", "angle RMS", "crossings", "manifold"]


def read(path):
    """Return a mesh's vertices, no two of them in one place, and its triangles."""
    import meshio
    import numpy

    mesh = meshio.read(path)
    if any(block.type != "triangle" for block in mesh.cells):
        raise SystemExit(f"{path}: has other cells than triangles")
    _, firsts, welded = numpy.unique(mesh.points, axis=0, return_index=True, return_inverse=True)
    order = numpy.argsort(firsts)  # Vertices stay in the file's order.
    renumbered = numpy.argsort(order)[welded.reshape(-1)]
    return mesh.points[firsts[order]], renumbered[numpy.vstack([block.data for block in mesh.cells]).astype(int)]


def write(path, vertices, triangles):
    """Write a mesh, as .off, with all digits."""
    lines = [f"OFF\n{len(vertices)} {len(triangles)} 0"]
    lines += ["{!r} {!r} {!r}".format(*vertex) for vertex in vertices.tolist()]
    lines += ["3 {} {} {}".format(*triangle) for triangle in triangles.tolist()]
    pathlib.Path(path).write_text("\n".join(lines) + "\n")


def timed(work):
    begin = time.perf_counter()
    result = work()
    return time.perf_counter() - begin, result


def length_of(vertices, triangles, n):
    """Return the edge length of a hexagonal lattice with n vertices on as large an area."""
    import numpy

    a, b, c = (vertices[triangles[:, i]] for i in range(3))
    area = numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1).sum() / 2
    return (2 * area / (3**0.5 * n)) ** 0.5


def searched(work, n, length):
    """Try edge lengths until there are n vertices, TRIES at most; return how many were tried, and the best."""
    tried = []
    for _ in range(TRIES):
        got = len(work(length)[0])
        tried.append((got, length))
        if got == n:
            break
        more, fewer = [t for t in tried if t[0] > n], [t for t in tried if t[0] < n]
        if more and fewer:
            (high, short), (low, long) = min(more), max(fewer)
            share = (high / n - 1) / (high / n - low / n)  # Straight between the nearest on either side.
            length = short + (long - short) * share
        else:
            length *= (got / n) ** 0.5
    return len(tried), min(tried, key=lambda t: abs(t[0] - n))[1]


def by_pyacvd(vertices, triangles, n):
    import numpy
    import pyacvd
    import pyvista

    halvings = 0
    while len(vertices) * 4**halvings < 25 * n:  # It has clusters of vertices, so there have to be many in each.
        halvings += 1

    def work():
        clusters = pyacvd.Clustering(mesh)
        clusters.subdivide(halvings)
        clusters.cluster(n)
        return clusters.create_mesh()

    seconds = []
    for _ in range(RUNS):
        mesh = pyvista.PolyData.from_regular_faces(vertices, triangles)
        took, made = timed(work)
        seconds.append(took)
    return min(seconds), 1, numpy.asarray(made.points, dtype=float), numpy.asarray(made.regular_faces)


def by_length(work, vertices, triangles, n):
    """Measure a rival whose argument is an edge length; work returns the vertices, the triangles and the seconds."""
    tries, length = searched(work, n, length_of(vertices, triangles, n))
    runs = [work(length) for _ in range(RUNS)]
    return min(run[2] for run in runs), tries, runs[-1][0], runs[-1][1]


def by_pymeshlab(crease):
    def of(vertices, triangles, n):
        import pymeshlab

        def work(length):
            meshes = pymeshlab.MeshSet()
            meshes.add_mesh(pymeshlab.Mesh(vertices, triangles))
            target = pymeshlab.PureValue(length)
            seconds, _ = timed(lambda: meshes.meshing_isotropic_explicit_remeshing(targetlen=target, featuredeg=crease))
            made = meshes.current_mesh()
            return made.vertex_matrix(), made.face_matrix(), seconds

        return by_length(work, vertices, triangles, n)

    return of


def by_gpytoolbox(**creases):
    def of(vertices, triangles, n):
        import gpytoolbox

        def work(length):
            seconds, made = timed(lambda: gpytoolbox.remesh_botsch(vertices, triangles, 10, length, **creases))
            return made[0], made[1], seconds

        return by_length(work, vertices, triangles, n)

    return of


RIVALS = {
    "pyacvd": (by_pyacvd, ["pyacvd", "pyvista"]),
    "pymeshlab": (by_pymeshlab(180), ["pymeshlab"]),
    "pymeshlab, creases": (by_pymeshlab(CREASE), ["pymeshlab"]),
    "gpytoolbox": (by_gpytoolbox(), ["gpytoolbox"]),
    "gpytoolbox, creases": (by_gpytoolbox(detect_feature_edges=True, feature_dihedral_threshold=CREASE), ["gpytoolbox"]),
}


def one(name, source, n, out):
    """Make one mesh and print how long it took, and after how many tries."""
    import numpy

    seconds, tries, vertices, triangles = RIVALS[name][0](*read(source), n)
    used, renumbered = numpy.unique(triangles, return_inverse=True)
    write(out, vertices[used], renumbered.reshape(-1, 3))
    print(json.dumps([seconds, tries]))


def by_evenly(command, source, n, out):
    """Make evenly's mesh; the whole command is timed, with its start, reading, measures and writing."""
    arguments = [command, "remesh", source, "-n", str(n), "-j", "1", "-o", out, "--force", "--quiet"]
    seconds = []
    for _ in range(RUNS):
        took, done = timed(lambda: subprocess.run(arguments, capture_output=True, text=True, timeout=PATIENCE, check=False))
        if done.returncode not in (0, 1):  # 1: the mesh is written, but targets are not reached everywhere.
            raise RuntimeError(done.stderr)
        seconds.append(took)
    return min(seconds), 1


def sides(triangles):
    """Return how many edges have one triangle, and how many more than two."""
    import numpy

    ends = numpy.sort(numpy.vstack([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    n_triangles = numpy.unique(ends, axis=0, return_counts=True)[1]
    return int((n_triangles == 1).sum()), int((n_triangles > 2).sum())


def manifold(m, source, triangles):
    """Say whether a mesh is a manifold with the input's boundaries: analyze mends what it measures, so edges are counted here."""
    boundary, crowded = sides(triangles)
    was = sides(read(source)[1])[0]
    if was == 0 and boundary > 0:
        return f"no: {crowded} edges with more than two triangles, {boundary} with one"
    if crowded > 0:
        return f"no: {crowded} edges with more than two triangles"
    return "yes" if m["is_manifold"] else "no"


def row(name, seconds, tries, out, command, source):
    """Return a mesh's row, as `evenly analyze` measures it."""
    import numpy

    done = subprocess.run([command, "analyze", out, "--reference", source, "--json"], capture_output=True, text=True, check=False)
    if not done.stdout.startswith("{"):
        raise RuntimeError(done.stderr)
    m = json.loads(done.stdout)
    triangles = read(out)[1]
    return [
        name,
        str(len(numpy.unique(triangles))),
        f"{seconds:.3g} s",
        str(tries),
        f"{m['min_angle_deg']:.2f} to {m['max_angle_deg']:.2f}",
        str(m["obtuse_triangles"]),
        f"{m['min_quality']:.3f}",
        f"{m['mean_quality']:.3f}",
        f"{100 * m['valence_567_fraction']:.2f} %",
        f"{m['rms']:.2e}".replace("e-0", "e-"),
        f"{m['hausdorff']:.2e}".replace("e-0", "e-"),
        f"{m['angle_rms_deg']:.2f}",
        str(m["self_intersections"]),
        manifold(m, source, triangles),
    ]


def table(source, n, command, folder):
    """Print an input's table."""
    print(f"\n{pathlib.Path(source).stem}:\n")
    print("| " + " | ".join(HEADER) + " |")
    print("|" + "---|" * len(HEADER))
    for name in ["evenly", *RIVALS]:
        out = str(folder / f"{name}.{'ply' if name == 'evenly' else 'off'}")
        try:
            if name == "evenly":
                seconds, tries = by_evenly(command, source, n, out)
            elif all(importlib.util.find_spec(module) for module in RIVALS[name][1]):
                arguments = [sys.executable, __file__, "--one", name, "-n", str(n), "-o", out, source]
                alone = {**os.environ, **ONE_THREAD}
                done = subprocess.run(arguments, capture_output=True, text=True, timeout=PATIENCE, env=alone, check=False)
                if done.returncode != 0:
                    raise RuntimeError(done.stderr)
                seconds, tries = json.loads(done.stdout.strip().splitlines()[-1])
            else:
                print(f"{name} is not installed", file=sys.stderr)
                continue
            cells = row(name, seconds, tries, out, command, source)
        except subprocess.TimeoutExpired:
            cells = [name, "-", f"> {PATIENCE} s", *["-"] * (len(HEADER) - 3)]
        except RuntimeError as error:
            print(f"{name}: {error}", file=sys.stderr)
            cells = [name, "-", "failed", *["-"] * (len(HEADER) - 3)]
        print("| " + " | ".join(cells) + " |", flush=True)


def main():
    """Print the tables, or make one mesh for them."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("meshes", nargs="+", help="closed or open, of triangles")
    parser.add_argument("--evenly", default="evenly", help="the command")
    parser.add_argument("-n", type=int, default=8500, help="how many vertices")
    parser.add_argument("--one", choices=RIVALS, help=argparse.SUPPRESS)
    parser.add_argument("-o", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.one:
        one(options.one, options.meshes[0], options.n, options.o)
        return
    with tempfile.TemporaryDirectory() as folder:
        for source in options.meshes:
            table(source, options.n, options.evenly, pathlib.Path(folder))


if __name__ == "__main__":
    main()
