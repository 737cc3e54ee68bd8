"""Test machines as scenes: contacts without a bearing."""

from .two_disk import DiskGeometry as DiskGeometry
from .two_disk import DiskMaterials as DiskMaterials
from .two_disk import DiskOperation as DiskOperation
from .two_disk import DiskState as DiskState
from .two_disk import TwoDisk as TwoDisk
from .two_disk import TwoDiskLaws as TwoDiskLaws
from .two_disk import TwoDiskSolution as TwoDiskSolution
from .two_disk import solve_two_disk as solve_two_disk
