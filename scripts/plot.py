#!/usr/bin/python3
from clatter.plots.cli import main

raise SystemExit(main())
