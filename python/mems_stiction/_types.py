"""What functions of this package take as surfaces, as types."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Iterable, Mapping, Sequence, Tuple, Union

import numpy as np

from mems_stiction._arrays import Pitch, Surface

if TYPE_CHECKING:
    from typing import Protocol

    class ScanLike(Protocol):
        """Scan of this package."""

        _surface: Surface

    class TopographyLike(Protocol):
        """Of SurfaceTopography: the first index is x, lengths are in its unit."""

        @property
        def physical_sizes(self) -> Any: ...

        def heights(self) -> Any: ...

    class DataArrayLike(Protocol):
        """Of xarray, over the dimensions y and x."""

        @property
        def dims(self) -> Tuple[Any, ...]: ...

        @property
        def coords(self) -> Any: ...

        @property
        def values(self) -> Any: ...


#: One surface: rows x columns [m], or an object or the path of a file that has them.
Heights = Union[
    np.ndarray,
    Sequence[Sequence[float]],
    "ScanLike",
    "TopographyLike",
    "DataArrayLike",
    str,
    "os.PathLike[str]",
]
#: What meets it, measured on the same grid; or settings of the upper body.
Upper = Union[Heights, Mapping[str, Any]]
#: Several surfaces of one part, or one; {path: pitch}.
Scans = Union[Heights, Iterable[Heights], Mapping[Any, Pitch]]
#: Those of the counter-surface; or settings of the upper body.
UpperScans = Union[Heights, Iterable[Heights], Mapping[str, Any]]
