"""Fits a garment that was modelled on one body to another body, with no triangle through another.

`dress` does it in one call, `Session` in as many as are wanted. docs/python.md is an introduction;
https://docs.python.org/3/library/functions.html#help says the rest: every item is documented.
"""

from ._dress import Dressed, MeshLike, Skeleton, SkeletonLike, Skin, dress
from ._enums import (
    Axis,
    DiagnosticKind,
    ElementKind,
    JointReason,
    PartRole,
    Severity,
    Stage,
    Status,
    Subject,
    SurfaceForm,
    Winding,
)
from ._errors import BespokeError, CancelledError, ImplausibleResultError, InvalidInputError
from ._handle import Control
from ._joints import AddedJoint, CoordinateSystem, Joint, MappedJoint
from ._library import path as library_path
from ._library import version as library_version
from ._options import OptionArguments, Options
from ._session import Session, read_default_options
from ._shared import Avatar, Garment
from ._values import (
    Diagnostic,
    Element,
    Energy,
    Intersections,
    PoseIntersections,
    Progress,
    Report,
    StageReport,
    WornPair,
)

__all__ = [
    "AddedJoint",
    "Avatar",
    "Axis",
    "BespokeError",
    "CancelledError",
    "Control",
    "CoordinateSystem",
    "Diagnostic",
    "DiagnosticKind",
    "Dressed",
    "Element",
    "ElementKind",
    "Energy",
    "Garment",
    "ImplausibleResultError",
    "Intersections",
    "InvalidInputError",
    "Joint",
    "JointReason",
    "MappedJoint",
    "MeshLike",
    "OptionArguments",
    "Options",
    "PartRole",
    "PoseIntersections",
    "Progress",
    "Report",
    "Session",
    "Severity",
    "Skeleton",
    "SkeletonLike",
    "Skin",
    "Stage",
    "StageReport",
    "Status",
    "Subject",
    "SurfaceForm",
    "Winding",
    "WornPair",
    "dress",
    "library_path",
    "library_version",
    "read_default_options",
]
