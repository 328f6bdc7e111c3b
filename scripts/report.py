#!/usr/bin/python3
from clatter.reports.cli import main

raise SystemExit(main())
