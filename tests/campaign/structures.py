"""All structures of the campaign."""

from campaign import balls, contacts, rollers, tapered

STRUCTURES = [*rollers.STRUCTURES, *balls.STRUCTURES, *tapered.STRUCTURES, *contacts.STRUCTURES]
