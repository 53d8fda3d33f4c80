"""Parameters and readings of an input script fitted to observed numbers."""
