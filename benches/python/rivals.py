"""evenly beside other packages from PyPI: the same numbers of points, one thread, one process a run.

Needs evenly, scipy, bridson, poisson_disc and blue-sampler; prints the table of docs/python/rivals.md.
"""

import os
import subprocess
import sys
import time

SIZES = [1000, 10_000, 100_000]
PATIENCE = 180
"""Seconds after which a run is given up."""


def radius(n):
    """Return the distance with which maximal sampling has about n points in the unit square."""
    return (0.7 / n) ** 0.5


def by_scipy(n):
    import numpy
    from scipy.stats import qmc

    engine = qmc.PoissonDisk(d=2, radius=radius(n), rng=numpy.random.default_rng(1))
    return lambda: engine.fill_space()


def by_bridson(n):
    import bridson

    return lambda: bridson.poisson_disc_samples(1.0, 1.0, radius(n))


def by_poisson_disc(n):
    import numpy
    import poisson_disc

    return lambda: poisson_disc.Bridson_sampling(dims=numpy.array([1.0, 1.0]), radius=radius(n))


def by_blue_sampler(n):
    import blue_sampler

    blue_sampler.sample_points(N=n, D=2)  # It compiles for each size first.
    return lambda: blue_sampler.sample_points(N=n, D=2)


def by_evenly(method):
    def of(n):
        import evenly

        return lambda: evenly.generate(n, method=method, seed=1, threads=1)

    return of


RIVALS = {
    "scipy.stats.qmc.PoissonDisk": (by_scipy, "rect"),
    "bridson": (by_bridson, "rect"),
    "poisson_disc": (by_poisson_disc, "rect"),
    "blue-sampler": (by_blue_sampler, "torus"),
    "evenly poisson-disk": (by_evenly("poisson-disk"), "torus"),
    "evenly procrustes": (by_evenly("procrustes"), "torus"),
    "evenly push-pull": (by_evenly("push-pull"), "torus"),
    "evenly well-spaced": (by_evenly("well-spaced"), "torus"),
}


def one(name, n):
    """Make one set, and print its row."""
    import evenly
    import numpy

    make, space = RIVALS[name]
    work = make(n)
    begin = time.perf_counter()
    points = numpy.asarray(work(), dtype=float)
    seconds = time.perf_counter() - begin
    points = points % 1.0 if space == "torus" else points
    measures = evenly.measure(points, space=space)
    spectrum = evenly.power_spectrum(points, space=space)
    low = spectrum.ring_power[spectrum.ring_frequencies < 0.5].mean()
    print(f"| {name} | {len(points)} | {seconds:.3g} s | {measures.min_distance:.3f} | {measures.beta:.3f} | {low:.4f} |")


def main():
    """Print the table."""
    print("| | points | time | smallest distance | beta | power below half the mean frequency |")
    print("|---|---|---|---|---|---|")
    alone = {**os.environ, "OMP_NUM_THREADS": "1", "XLA_FLAGS": "--xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1"}
    for n in SIZES:
        for name in RIVALS:
            try:
                done = subprocess.run([sys.executable, __file__, name, str(n)], capture_output=True, text=True, timeout=PATIENCE, env=alone, check=False)
                row = done.stdout.strip().splitlines()[-1:] or [f"| {name} | {n} | failed | - | - | - |"]
                print(row[0], flush=True)
            except subprocess.TimeoutExpired:
                print(f"| {name} | {n} | > {PATIENCE} s | - | - | - |", flush=True)


if __name__ == "__main__":
    if len(sys.argv) > 1:
        one(sys.argv[1], int(sys.argv[2]))
    else:
        main()
