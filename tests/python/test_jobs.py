"""Long calls leave Python free, and Ctrl-C ends them at once and loses nothing."""

import multiprocessing
import os
import signal
import subprocess
import sys
import textwrap
import threading
import time

import evenly
import numpy as np
import pytest

N = 200_000


def test_another_thread_goes_on():
    ticks = []
    done = threading.Event()

    def tick():
        while not done.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.002)

    other = threading.Thread(target=tick)
    other.start()
    evenly.generate(N, method="lloyd", iterations=5)
    done.set()
    other.join()
    assert len(ticks) > 3


def interrupted(code):
    """Run code that prints READY once it is at work, interrupt it, and return what it says then."""
    child = subprocess.Popen([sys.executable, "-c", textwrap.dedent(code)], stdout=subprocess.PIPE, text=True)
    assert child.stdout.readline().strip() == "READY"
    child.send_signal(signal.SIGINT)
    said, _ = child.communicate(timeout=60)
    return child.returncode, said


@pytest.mark.skipif(sys.platform == "win32", reason="signals are sent otherwise")
@pytest.mark.parametrize(
    "call",
    [
        f"evenly.generate({N}, method='lloyd', iterations=100_000, callback=ready)",
        "evenly.mesh([(0, 0), (1, 0), (1, 1), (0, 1)], edge_length=0.003, method='lloyd', iterations=100_000, callback=ready)",
        "evenly.stipple(numpy.tile(numpy.linspace(0, 1, 500), (500, 1)), 200_000, method='lloyd', iterations=100_000, callback=ready)",
    ],
)
def test_an_interrupt_is_raised_and_keeps_the_state(call):
    code, said = interrupted(f"""
        import numpy, evenly
        def ready(iteration, progress):
            if iteration == 1:
                print("READY", flush=True)
        try:
            {call}
        except evenly.Interrupted as stopped:
            partial = stopped.partial
            print(isinstance(stopped, KeyboardInterrupt), len(numpy.asarray(getattr(partial, "vertices", partial))) > 1000)
            print(stopped.partial is partial)
    """)
    assert code == 0
    assert said.split() == ["True", "True", "True"]


@pytest.mark.skipif(not hasattr(os, "fork"), reason="there is no fork")
@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_forks_work():
    before = evenly.generate(2000, method="push-pull", seed=4).positions
    with multiprocessing.get_context("fork").Pool(2) as pool:
        for positions in pool.map(_made, [4, 4]):
            np.testing.assert_array_equal(positions, before)


def _made(seed):
    return np.asarray(evenly.generate(2000, method="push-pull", seed=seed))


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="there is no alarm")
def test_what_another_signal_raises_is_raised():
    class Late(Exception):
        pass

    def raise_late(_number, _frame):
        raise Late

    before = signal.signal(signal.SIGALRM, raise_late)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.3)
        with pytest.raises(Late):
            evenly.generate(N, method="lloyd", iterations=100_000)
    finally:
        signal.signal(signal.SIGALRM, before)


def test_a_partial_that_failed_fails_again():
    def fail():
        raise ZeroDivisionError

    interrupted = evenly.Interrupted(fail)
    for _ in range(2):
        with pytest.raises(ZeroDivisionError):
            _ = interrupted.partial


@pytest.mark.skipif(sys.platform == "win32", reason="signals are sent otherwise")
def test_an_interrupted_comparison_keeps_its_runs():
    code, said = interrupted(f"""
        import threading, evenly
        threading.Timer(0.5, lambda: print("READY", flush=True)).start()
        try:
            evenly.compare({N}, methods=["white", "lloyd"], runs=1000)
        except evenly.Interrupted as stopped:
            print(type(stopped.partial).__name__)
    """)
    assert (code, said.split()) == (0, ["Comparison"])
