"""Types of the compiled part, written by scripts/lib/core_stub.py. Users import mems_stiction, which checks what it hands over."""

from typing import Any, Dict, List, Optional, Sequence, Tuple

import numpy as np

class DeviceForceFigures:
    pull_off_force: float
    """[N] of the device, median"""
    pull_off_force_lower: float
    """[N] 2.5 % quantile"""
    pull_off_force_upper: float
    """[N] 97.5 % quantile"""
    apparent_work_of_adhesion: float
    """[J/m^2] per nominal area, median"""
    apparent_work_of_adhesion_lower: float
    """[J/m^2] 2.5 % quantile"""
    apparent_work_of_adhesion_upper: float
    """[J/m^2] 97.5 % quantile"""
    linear_pull_off_force: float
    """[N] the scans' force by area, for comparison"""
    contacts: float
    """places that hold at the pull-off, median"""
    separation_at_rest: float
    """[m] mean gap, median"""
    is_conforming: bool
    """the surfaces bond all over: force and work go with area"""
    area: float
    """[m^2] nominal, of all contacts"""
    pitch: float
    """[m] of the made surfaces"""
    force_deviation: float
    """standard deviation of ln force but for constants and model"""

class HalfSpaceFigures:
    status: str
    """SOLVED, LOAD_NOT_REACHED, NOT_CONVERGED, TOO_MANY_STATES or CANCELLED"""
    pull_off_force: float
    """[N] largest attraction while the bodies are drawn apart, after voltage and load have gone"""
    contact_area: float
    """[m^2] cells that repel each other at rest"""
    contact_fraction: float
    """contact_area over the area of the valid cells"""
    mean_gap: float
    """[m] at rest, over the valid cells"""
    apparent_work_of_adhesion: float
    """[J/m^2] from zero force to apart, per area of the valid cells"""
    adhesion_hysteresis: float
    """[J/m^2] what a whole cycle costs, by jumps and by flow, per area of the valid cells"""
    is_converged: bool
    """status is SOLVED: the path came to its end, and every state of it is an equilibrium, to half_space/tolerance where it counts"""
    is_resolved: bool
    """pixels are small enough for the edge of a contact: at least two per cohesive_length"""
    iterations: int
    """Newton steps of all states"""
    processing_time: float
    """[s] wall time of the solution"""
    pull_off_force_under_voltage: float
    """[N] largest attraction if the voltage stays on instead"""
    contact_stiffness: float
    """[N/m] by which the force changes with the height as the bodies leave rest"""
    message: str
    """the status in a sentence"""
    pull_off_uncertainty: float
    """[N] by which finer steps may exceed pull_off_force"""
    pull_off_height: float
    """[m] of the upper body then, over first touch"""
    rest_height: float
    """[m] of the upper body at rest, over first touch"""
    rest_force: float
    """[N] there: minus the mechanical load"""
    contact_count: int
    """connected groups of the cells in contact"""
    flowed_volume: float
    """[m^3] that both surfaces have lost for good, after the whole path"""
    range: float
    """[m] z0, the gap at which the traction changes its sign"""
    cohesive_length: float
    """[m] E z0^2/Gamma, or E d/p of water, over which the edge of a contact parts"""
    is_step_converged: bool
    """finer steps change pull_off_force by less than 2 %"""
    residual: float
    """the largest of all states"""
    state_count: int
    """heights that were solved"""
    jumps: int
    """places where the curve is not continuous, both ways"""

class PredictionFigures:
    status: str
    """EQUILIBRIUM, BONDED or NO_EQUILIBRIUM (then do not use the forces)"""
    steps: int
    """of the approach that were taken"""
    voltage: float
    """[V] across the interface"""
    mechanical_load: float
    """[N] pressing, on the scanned area"""
    van_der_waals_force: float
    """[N] attraction of the cells out of contact (2)"""
    electrostatic_force: float
    """[N] attraction by voltage and contact potential (3)"""
    normal_load: float
    """[N] mechanical, van der Waals, electrostatic, capillary together"""
    capillary_force: float
    """[N] of condensed water, part of normal_load; 0 when off"""
    pull_off_force: float
    """[N] largest while the surfaces are drawn apart, after voltage and load have gone; (11) of the paper"""
    pull_off_force_jkr: float
    """[N] (3/2) pi Gamma times the sum of the composite radii"""
    pull_off_force_transition: float
    """[N] the same sum with the prefactor of the JKR-DMT transition for each contact"""
    contact_area: float
    """[m^2] real area of contact; of the paper's formulations all cells that overlap"""
    contact_area_jkr: float
    """[m^2] sum of the JKR contacts"""
    nominal_area: float
    """[m^2] valid cells of the scan"""
    contact_fraction: float
    """contact_area/nominal_area"""
    approach: float
    """[m] of the surfaces from first touch"""
    mean_gap: float
    """[m] over the cells out of contact"""
    mechanical_energy: float
    """[J] of the load (10.1)"""
    surface_energy: float
    """[J] of the surfaces that touch (10.1)"""
    elastic_energy: float
    """[J] stored in the bodies (10.2)"""
    total_energy: float
    """[J] mechanical + surface - elastic (8)"""
    plastic_work: float
    """[J] dissipated in flow along the approach"""
    bonding_energy: float
    """[J/m^2] total_energy/nominal_area"""
    normalized_bonding_energy: float
    """bonding_energy/work of adhesion; NaN when that is 0"""
    apparent_work_of_adhesion: float
    """[J/m^2] of drawing the surfaces apart, per nominal area"""
    contact_stiffness: float
    """[N/m] -dF/dD at rest"""
    flattening_energy: float
    """[J/m^2] that pressing the surfaces flat would store, per area"""
    flattening_ratio: float
    """flattening_energy over what adhesion and water give"""
    adhesion_exponent: float
    """d ln(pull_off_force)/d ln(work of adhesion)"""
    modulus_exponent: float
    """d ln(pull_off_force)/d ln(contact modulus)"""
    is_conforming: bool
    """flattening costs less than adhesion gives: flat against each other nearly everywhere"""
    adhesion_parameter: float
    """mean of (E/Gamma) sqrt(sigma^3/R) (14); infinite when Gamma is 0"""
    bonding_regime: str
    """BONDING, ADHERENCE, NON_BONDING or UNKNOWN by the adhesion parameter (Gui et al. 1999)"""
    asperity_count: int
    """contacts at rest"""
    elastic_count: int
    """of them elastic"""
    elasto_plastic_count: int
    """of them elasto-plastic"""
    plastic_count: int
    """of them fully plastic"""
    max_tilt: float
    """[rad] largest tilt of a contact"""
    median_tabor_parameter: float
    """of the contacts; infinite when adhesion has no range, NaN without contact"""
    contact_theory: str
    """DMT, TRANSITION, JKR or UNKNOWN by the median Tabor parameter (Johnson and Greenwood 1997)"""
    composite_rms_height: float
    """[m] sqrt(sigma1^2 + sigma2^2) (9)"""
    rms_height: float
    """[m] of the scanned surface"""
    invalid_fraction: float
    """share of pixels that are invalid in either surface"""
    processing_time: float
    """[s] wall time of this prediction"""
    median_contact_pixels: float
    """pixels of the scan in half of the contacts or fewer; NaN without contact"""
    median_composite_radius: float
    """[m] median of the composite radii; NaN without contact"""
    is_resolution_limited: bool
    """median_contact_pixels is below resolution/min_contact_pixels"""
    is_tip_limited: bool
    """the tip is blunter than the contacts: its radius exceeds median_composite_radius"""
    tip_limit: float
    """[m] shorter waves of the scan, and contacts of a smaller diameter, are drawn by the tip: over this length the sharpest summit has half of its curvature; 0 none, NaN where no tip is stated"""
    below_tip_count: int
    """contacts at the pull-off that are smaller than tip_limit; -1 not known"""
    pull_off_contact_count: int
    """contacts that hold at the pull-off, on which flags and verdict rest; -1 not known"""
    unresolved_height: float
    """[m] rms height of the waves that pixels or tip do not show, continued from those that they do; NaN not known"""
    unresolved_limit: float
    """[m] of it, above which the scan does not show what holds: what adhesion bridges"""
    needed_pitch: float
    """[m] pixels of a scan that would show what holds; NaN where this one does"""
    is_lower_bound: bool
    """pull_off_force is a lower bound: the search ended before the contacts stopped growing"""
    formulation: str
    """whose answer it is"""
    regime_flags: int
    """where the model leaves its range: bits, of which flags has the names (doc/validity.md)"""
    scan_name: str
    """scan_info.scan_name, else the frame_id"""
    part_id: str
    """scan_info.part_id, else the parameter part/id"""
    serial_id: str
    """scan_info.serial_id, else the parameter part/serial"""
    lot_id: str
    """scan_info.lot_id, else the parameter part/lot"""
    wafer_id: str
    """scan_info.wafer_id, else the parameter part/wafer"""
    site_x: float
    """[m] where on its wafer the scan was taken"""
    site_y: float
    """[m] where on its wafer the scan was taken"""
    acquisition_time: str
    """when it was measured, by ISO 8601; without a zone where the file states none"""
    instrument: str
    """it was measured with"""
    operator_name: str
    """who measured it"""
    checksum: str
    """sha256: and 64 hexadecimal digits, of the bytes of the scan's file"""

class RoughnessFigures:
    sa: float
    """[m] arithmetical mean height"""
    sq: float
    """[m] root mean square height"""
    ssk: float
    """skewness"""
    sku: float
    """kurtosis; 3 for a Gaussian surface"""
    sp: float
    """[m] maximum peak height"""
    sv: float
    """[m] maximum pit depth, positive"""
    sz: float
    """[m] maximum height, sp + sv"""
    sdq: float
    """root mean square gradient"""
    sdr: float
    """developed interfacial area ratio"""
    sal: float
    """[m] autocorrelation length, to 0.2"""
    str: float
    """texture aspect ratio: near 1 isotropic, near 0 a lay"""
    m0: float
    """[m^2] mean squared height of a profile, averaged over its directions"""
    m2: float
    """mean squared slope of a profile"""
    m4: float
    """[1/m^2] mean squared curvature of a profile"""
    nayak: float
    """Nayak's parameter, m0 m4/m2^2"""
    summit_density: float
    """[1/m^2] summits per area"""
    mean_summit_radius: float
    """[m] 1/mean curvature of the summits"""
    hurst: float
    """exponent of the self-affine range"""

class ScanIdentityFigures:
    scan_name: str
    """scan_info.scan_name, else the frame_id"""
    part_id: str
    """scan_info.part_id, else the parameter part/id"""
    serial_id: str
    """scan_info.serial_id, else the parameter part/serial"""
    lot_id: str
    """scan_info.lot_id, else the parameter part/lot"""
    wafer_id: str
    """scan_info.wafer_id, else the parameter part/wafer"""
    site_x: float
    """[m] where on its wafer the scan was taken"""
    site_y: float
    """[m] where on its wafer the scan was taken"""
    acquisition_time: str
    """when it was measured, by ISO 8601; without a zone where the file states none"""
    instrument: str
    """it was measured with"""
    operator_name: str
    """who measured it"""
    checksum: str
    """sha256: and 64 hexadecimal digits, of the bytes of the scan's file"""

class VerdictFigures:
    sticks: str
    """no, marginal, yes or unknown"""
    reason: str
    """of sticks, one sentence"""
    restoring_force: float
    """[N] of the device's spring"""
    device_pull_off_force: float
    """[N] of the whole device"""
    margin: float
    """restoring over pull-off force: above 1 the spring wins; infinite without adhesion"""
    margin_lower: float
    """2.5 % quantile of margin"""
    margin_upper: float
    """97.5 % quantile of margin"""
    margin_uncertainty: float
    """half of the central 68 % interval of margin"""
    margin_transition: float
    """margin with the prefactors of the JKR-DMT transition"""
    device_apparent_work_of_adhesion: float
    """[J/m^2] of the device's interface, per nominal area, which beams peel"""
    peel_number: float
    """of the beam: above 1 it comes off (de Boer and Michalske 1999)"""
    peel_number_lower: float
    """2.5 % quantile of peel_number"""
    peel_number_upper: float
    """97.5 % quantile of peel_number"""
    detachment_length: float
    """[m] longest beam that comes off by itself (Mastrangelo and Hsu 1993)"""
    unstuck_length: float
    """[m] free arm of the beam while it is stuck"""
    pull_in_voltage: float
    """[V] at which the electrodes close"""
    regime_flags: int
    """where the model leaves its range: bits, 0 when all is well"""
    device_pull_off_force_lower: float
    """[N] 2.5 % quantile of device_pull_off_force"""
    device_pull_off_force_upper: float
    """[N] 97.5 % quantile of device_pull_off_force"""
    governed_by: str
    """force or peeling: which of margin and peel number decides whether a beam sticks; empty where one is all there is"""
    verdict_by: str
    """whose figures it rests on: prediction or half_space"""

class Configuration:
    def __init__(self) -> None: ...
    def changed(self, tree: Dict[str, Any], over: Dict[str, Any]) -> Configuration: ...
    def loaded(self, path: bytes, over: Dict[str, Any]) -> Configuration: ...
    def read(self, text: str) -> Configuration: ...
    warnings: List[str]
    pitch: Tuple[float, float]
    def yaml(self) -> str: ...

class ContactCyclesResult:
    cycles: Records
    first_sticking_cycle: int
    why_no_margin: str
    lower: HeightMap
    upper: HeightMap

class DevicePrediction:
    figures: Dict[str, Any]
    verdict: Optional[Dict[str, Any]]
    scans: List[str]
    scan_warnings: List[str]
    force_warnings: List[str]
    warnings: List[str]
    realisations: Records
    parts_of_scans: Records
    spectrum: Records
    work_deviation: float
    made_surface: HeightMap
    def json(self) -> str: ...

class DeviceScan:
    def __init__(self, name: str, scan: HeightMap, notes: Sequence[str], identity: ScanIdentity) -> None: ...

class HeightMap:
    pixels: Optional[Memory]
    pitch: Tuple[float, float]

class LoadSweepResult:
    points: Records
    summaries: Records
    pull_in_voltage: float
    pull_in_reason: str
    why_no_margin: str

class MadeSurface:
    def __init__(self, scans: Sequence[DeviceScan], counter_surface: Sequence[DeviceScan], configuration: Configuration, number: int, depth: Optional[float]) -> None: ...
    warnings: List[str]
    rows: int
    cols: int
    pitch: float
    tile_rows: int
    def heights(self, row: int, col: int, rows: int, cols: int) -> Optional[Memory]: ...
    def cells(self, first_row: int, rows: int) -> bytes: ...
    def strips(self) -> SurfaceStrips: ...
    def adhesion(self, strips: SurfaceStrips) -> SurfaceAdhesion: ...

class Memory: ...

class OneScan:
    def __init__(self, scan: HeightMap, counter_surface: Optional[HeightMap], configuration: Configuration, notes: Sequence[str], identity: ScanIdentity) -> None: ...
    scan_warnings: List[str]
    def predict(self, configuration: Configuration) -> PredictedScan: ...

class PredictedScan:
    figures: Dict[str, Any]
    verdict: Optional[Dict[str, Any]]
    device_force: Optional[Dict[str, Any]]
    half_space: Optional[Dict[str, Any]]
    roughness: Dict[str, Any]
    flag_names: str
    model_doubt: str
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
    def predict(self, scan: HeightMap, counter_surface: Optional[HeightMap], notes: Sequence[str], identity: ScanIdentity) -> PredictedScan: ...

class PreparedScan:
    warnings: List[str]
    lower: HeightMap
    upper: Optional[HeightMap]

class Records:
    bytes: Memory
    record_size: int
    fields: List[Tuple[str, str, int]]

class ScanIdentity:
    def __init__(self) -> None: ...
    figures: Dict[str, Any]

class SolvedScan:
    figures: Dict[str, Any]
    verdict: Optional[Dict[str, Any]]
    origin: Dict[str, Any]
    curve: Records
    pressure: Optional[Memory]
    gap: Optional[Memory]
    contact_map: Optional[Memory]
    deformed_lower: HeightMap
    deformed_upper: HeightMap

class SurfaceAdhesion:
    record: Records
    warnings: List[str]

class SurfaceStrips:
    def add(self, part: bytes) -> None: ...

class Error(Exception): ...

class FileError(Error, OSError): ...

class OptionsError(Error, ValueError): ...

class SurfaceError(Error, ValueError): ...

def channels(path: bytes, configuration: Configuration) -> List[Dict[str, Any]]: ...
def chosen_columns(names: Sequence[str], known: Sequence[str], wanted: Optional[str] = None) -> List[str]: ...
def clean(scan: HeightMap, configuration: Configuration) -> Tuple[HeightMap, List[Dict[str, Any]], List[str]]: ...
def column_groups() -> List[Tuple[str, str]]: ...
def crack_length(beam_type: str, thickness: float, gap: float, modulus: float, residual_stress: float, work: float) -> float: ...
def cycle_contact(prepared: PreparedScan, configuration: Configuration, count: int) -> ContactCyclesResult: ...
def decimate(scan: HeightMap, factor: int) -> HeightMap: ...
def detachment_length(beam_type: str, thickness: float, gap: float, modulus: float, residual_stress: float, work: float) -> float: ...
def generate(rows: int, cols: int, pitch_x: float, pitch_y: float, configuration: Configuration) -> HeightMap: ...
def half_space(prepared: PreparedScan, identity: ScanIdentity, configuration: Configuration) -> SolvedScan: ...
def half_space_warnings(prepared: PreparedScan, configuration: Configuration) -> List[str]: ...
def height_map(pixels: np.ndarray, pitch_x: float, pitch_y: float, configuration: Configuration) -> HeightMap: ...
def predict_device(scans: Sequence[DeviceScan], counter_surface: Sequence[DeviceScan], configuration: Configuration) -> DevicePrediction: ...
def predict_device_under(scans: Sequence[DeviceScan], counter_surface: Sequence[DeviceScan], configuration: Configuration, models: Sequence[Configuration]) -> List[DevicePrediction]: ...
def prepare(scan: HeightMap, counter_surface: Optional[HeightMap], configuration: Configuration) -> PreparedScan: ...
def read(path: bytes, configuration: Configuration, pitch_x: float, pitch_y: float, channel: str, ignore_mask: bool) -> Tuple[HeightMap, str, List[str], ScanIdentity]: ...
def regime_flag_sentences(flags: int, doubt: str) -> List[str]: ...
def roughness(scan: HeightMap, configuration: Configuration, is_spatial: bool, is_periodic: bool) -> Tuple[Dict[str, Any], List[str]]: ...
def scan_warnings(scan: HeightMap) -> List[str]: ...
def sweep_loads(prepared: PreparedScan, configuration: Configuration, voltages: Sequence[float], mechanical_loads: Sequence[float]) -> LoadSweepResult: ...
def version() -> str: ...
figures: Dict[str, Dict[str, Tuple[str, str, str]]]  # {class: {name: (type, unit, meaning)}}
