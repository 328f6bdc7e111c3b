"""Pictures of outputs: clatter.plot and the command clatter-plot. Importing it loads no library."""
