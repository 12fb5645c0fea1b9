"""What is promised of the package as a whole."""

import doctest
import inspect
import pkgutil
import subprocess
import sys

import evenly
import pytest

MODULES = [name for _, name, _ in pkgutil.iter_modules(evenly.__path__, "evenly.") if not name.endswith("._evenly")]


@pytest.mark.parametrize("name", ["evenly", *MODULES])
def test_examples_are_true(name):
    # plot and qmc take more than the package itself.
    found = doctest.testmod(pytest.importorskip(name))
    assert found.failed == 0


@pytest.mark.parametrize("name", [name for name in evenly.__all__ if inspect.isfunction(getattr(evenly, name))])
def test_functions_are_documented(name):
    function = getattr(evenly, name)
    text = inspect.getdoc(function)
    for section in ("Parameters", "Returns", "Raises", "Examples"):
        assert f"{section}\n{'-' * len(section)}" in text, section
    for parameter in inspect.signature(function).parameters:
        assert parameter in text, parameter


def test_stubs_are_those_of_the_module():
    pytest.importorskip("mypy")
    done = subprocess.run([sys.executable, "-m", "mypy.stubtest", "evenly._evenly"], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout


def test_importing_takes_numpy_alone():
    code = "import evenly, sys; print([name for name in ('scipy', 'matplotlib', 'shapely', 'pandas') if name in sys.modules])"
    assert subprocess.check_output([sys.executable, "-c", code], text=True).strip() == "[]"


def test_the_command_is_there():
    done = subprocess.run([sys.executable, "-m", "evenly", "--version"], capture_output=True, text=True, check=False)
    assert done.stdout == f"evenly {evenly.__version__}\n"
    assert subprocess.run([sys.executable, "-m", "evenly", "nonsense"], capture_output=True, check=False).returncode == 2
