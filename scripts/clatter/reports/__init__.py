"""Pages of outputs: clatter.report and the command clatter-report. Importing it loads no library."""
