"""What is promised of the package as a whole."""

import doctest
import inspect
import pkgutil
import subprocess
import sys
import typing

import evenly
import pytest
from evenly import _methods

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


def test_signatures_know_what_the_registry_knows():
    methods = evenly.methods().values()
    options = set(typing.get_type_hints(_methods.MethodOptions))
    assert options == {name for method in methods for name in method.parameters}
    choices = {name: parameter.choices for method in methods for name, parameter in method.parameters.items() if parameter.kind == "choice"}
    hints = typing.get_type_hints(_methods.MethodOptions)
    assert {name: set(typing.get_args(typing.get_args(hints[name])[0])) for name in choices} == {name: set(each) for name, each in choices.items()}
    for alias, job in ((_methods.Optimizer, "optimize"), (_methods.OnMeshes, "remesh"), (_methods.OnMeshes, "mesh"), (_methods.OnSurfaces, "sample")):
        names = {name for each in typing.get_args(alias) for name in (typing.get_args(each) or (each,))}
        assert names == {method.name for method in methods if job in method.jobs}, job
    with pytest.raises(TypeError, match="unexpected keyword argument 'colour'"):
        evenly.generate(10, colour=1)
