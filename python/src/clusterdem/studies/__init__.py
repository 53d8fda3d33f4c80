"""What studies share: their file, the engine, the input script, and runs that are done once."""
