"""Gas fields for ``fix drag/cluster … field``: made from CFD results, checked, drawn."""
