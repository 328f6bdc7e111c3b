"""Runs clatter from Python: configurations as files or dictionaries, results as xarray datasets.

    import clatter

    data = clatter.run("configs/fig22.toml", scene={"R": 0.8})
    scene = {"xs": 4, "f": -1, "h": 0.1}
    data = clatter.run({"scene": scene, "sweep": {"nu": [0.9, 1.0]}, "observe": {"extrema": True}})
    data.x_max.plot()

The program does all the work: values are those of the file that `clatter run` writes, and keys are those of
`clatter help configuration`. The program is the one that the variable CLATTER names, else `clatter` on PATH.
"""

from ._program import ClatterError, ClatterWarning, ConfigError, branch, plan, run

__all__ = ["ClatterError", "ClatterWarning", "ConfigError", "branch", "plan", "run"]
__version__ = "0.2.0"
