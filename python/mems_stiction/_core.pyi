"""Types of the compiled part. Users import mems_stiction, which checks what it hands over."""

from typing import Any, Dict, List, Optional, Sequence, Tuple

import numpy as np

class Error(Exception): ...
class OptionsError(Error, ValueError): ...
class SurfaceError(Error, ValueError): ...
class FileError(Error, OSError): ...

class Memory: ...

class Records:
    bytes: Memory
    record_size: int
    fields: List[Tuple[str, str, int]]

class HeightMap:
    pixels: Optional[Memory]
    pitch: Tuple[float, float]

class Configuration:
    def __init__(self) -> None: ...
    def changed(self, tree: Dict[str, Any]) -> Configuration: ...
    def loaded(self, path: str) -> Configuration: ...
    def read(self, text: str) -> Configuration: ...
    warnings: List[str]
    pitch: Tuple[float, float]
    def yaml(self) -> str: ...

class PredictedScan:
    figures: Dict[str, Any]
    verdict: Optional[Dict[str, Any]]
    roughness: Dict[str, float]
    flag_names: str
    preprocessing: List[Dict[str, Any]]
    scan_warnings: List[str]
    warnings: List[str]
    scan: HeightMap
    lower: HeightMap
    upper: HeightMap
    contact_map: Optional[Memory]
    deformed_lower: Optional[Memory]
    deformed_upper: Optional[Memory]
    pressure: Optional[Memory]
    asperities: Records
    energy_curve: Records
    curve: Records
    curve_over_height: Records
    def spread(self, configuration: Configuration) -> List[float]: ...
    def json(self, file: str) -> str: ...

class Predictor:
    def __init__(self, configuration: Configuration) -> None: ...
    def predict(
        self, scan: HeightMap, counter_surface: Optional[HeightMap], notes: Sequence[str]
    ) -> PredictedScan: ...

class OneScan:
    scan_warnings: List[str]
    def __init__(
        self,
        scan: HeightMap,
        counter_surface: Optional[HeightMap],
        configuration: Configuration,
        notes: Sequence[str],
    ) -> None: ...
    def predict(self, configuration: Configuration) -> PredictedScan: ...

class PreparedScan:
    warnings: List[str]

class SolvedScan:
    figures: Dict[str, Any]
    verdict: Optional[Dict[str, Any]]
    curve: Records
    pressure: Optional[Memory]
    gap: Optional[Memory]
    contact_map: Optional[Memory]
    deformed_lower: HeightMap
    deformed_upper: HeightMap

class LoadSweepResult:
    points: Records
    summaries: Records
    pull_in_voltage: float

class ContactCyclesResult:
    cycles: Records
    first_sticking_cycle: int
    lower: HeightMap
    upper: HeightMap

def height_map(pixels: np.ndarray, pitch_x: float, pitch_y: float, configuration: Configuration) -> HeightMap: ...
def prepare(
    scan: HeightMap, counter_surface: Optional[HeightMap], configuration: Configuration
) -> PreparedScan: ...
def scan_warnings(scan: HeightMap) -> List[str]: ...
def read(
    path: str, configuration: Configuration, pitch_x: float, pitch_y: float, channel: str, ignore_mask: bool
) -> Tuple[HeightMap, str, List[str]]: ...
def channels(path: str, configuration: Configuration) -> List[Dict[str, Any]]: ...
def clean(scan: HeightMap, configuration: Configuration) -> Tuple[HeightMap, List[Dict[str, Any]]]: ...
def roughness(scan: HeightMap, configuration: Configuration, is_spatial: bool) -> Dict[str, float]: ...
def generate(rows: int, cols: int, pitch_x: float, pitch_y: float, configuration: Configuration) -> HeightMap: ...
def decimate(scan: HeightMap, factor: int) -> HeightMap: ...
def roughness_units() -> Dict[str, str]: ...
def prediction_units() -> Dict[str, Dict[str, str]]: ...
def half_space(prepared: PreparedScan, configuration: Configuration) -> SolvedScan: ...
def half_space_units() -> Dict[str, str]: ...
def sweep_loads(
    prepared: PreparedScan,
    configuration: Configuration,
    voltages: Sequence[float],
    mechanical_loads: Sequence[float],
) -> LoadSweepResult: ...
def cycle_contact(prepared: PreparedScan, configuration: Configuration, count: int) -> ContactCyclesResult: ...
