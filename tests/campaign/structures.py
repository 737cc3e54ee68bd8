"""All structures of the campaign."""

from campaign import rollers

STRUCTURES = [*rollers.STRUCTURES]
