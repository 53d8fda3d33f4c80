"""The paper's numbers, its scale and its size classes, for the paper's cases alone."""
