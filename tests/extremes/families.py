"""All families: importing them registers them."""

import families_contact
import families_events
import families_gas
import families_gran_cluster
import families_guests
import families_moving_guests
import families_neighbors
import families_resumed
import families_step_control
from family import FAMILIES, SEED

__all__ = [
    "FAMILIES",
    "SEED",
    "families_contact",
    "families_events",
    "families_gas",
    "families_gran_cluster",
    "families_guests",
    "families_moving_guests",
    "families_neighbors",
    "families_resumed",
    "families_step_control",
]
