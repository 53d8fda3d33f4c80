"""What frames say: maps, sizes, profiles, uniformity, conservation."""
