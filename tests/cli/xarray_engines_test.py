"""The guide's example for xarray, with each of the engines that read netCDF-4 missing."""

import os
import re
import subprocess
import sys
from pathlib import Path
from unittest import main

import h5py
import numpy

from command_line import LONGEST
from runs import RunTest

SOURCE = Path(os.environ["CLATTER_SOURCE"])


class Engines(RunTest):
    def test_the_guides_example_for_xarray_needs_only_one_of_its_engines(self):
        guide = (SOURCE / "src/results/README.md").read_text()
        (example,) = (block for block in re.findall(r"```python\n(.*?)```", guide, re.S) if "import xarray" in block)
        (self.scratch / "out").mkdir()
        path = self.run_clatter((SOURCE / "configs/fig22.toml").read_text(), "out/fig22")
        with h5py.File(path) as file:
            expected = file["x_max"][numpy.abs(file["nu"][:] - 1.2).argmin()]
        for missing in ("h5netcdf", "netCDF4"):
            code = f"import sys\nsys.modules['{missing}'] = None\n{example}"
            done = subprocess.run(
                [sys.executable, "-c", code],
                cwd=self.scratch,
                env={**os.environ, "MPLBACKEND": "Agg"},
                capture_output=True,
                text=True,
                check=False,
                timeout=LONGEST,
            )
            self.assertEqual((done.returncode, done.stderr), (0, ""), f"without {missing}")
            self.assertEqual(float(done.stdout), expected)


if __name__ == "__main__":
    main()
