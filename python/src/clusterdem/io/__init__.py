"""Files in and out: dumps, tables and logs of a run; VTK, tables, MDAnalysis."""
