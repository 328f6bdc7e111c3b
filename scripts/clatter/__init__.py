"""Runs clatter from Python: configurations as files or dictionaries, results as xarray datasets.

    import clatter

    data = clatter.run("configs/fig22.toml", scene={"R": 0.8})
    scene = {"xs": 4, "f": -1, "h": 0.1}
    data = clatter.run({"scene": scene, "sweep": {"nu": [0.9, 1.0]}, "observe": {"extrema": True}})
    data.x_max.plot()
    figure = clatter.plot("fig22.h5", only="x_max")

The program does all the work: values are those of the file that `clatter run` writes, and keys are those of
`clatter help configuration`. The program is the one that the variable CLATTER names, else that beside the
package, installed or built, else `clatter` on PATH. Pictures
and pages are those of the commands clatter-plot and clatter-report; they need the extras clatter[plot] and
clatter[report].
"""

from ._pictures import plot, report
from ._program import ClatterError, ClatterWarning, ConfigError, branch, plan, run

__all__ = ["ClatterError", "ClatterWarning", "ConfigError", "branch", "plan", "plot", "report", "run"]
__version__ = "0.3.0"
