"""Types of sensor_msgs.msg; generated."""

import array
import builtin_interfaces.msg
import geometry_msgs.msg
import numpy
import numpy.typing
import std_msgs.msg
from collections.abc import Iterable
from typing import Any, ClassVar, TypeAlias

from turtlewire.msg import Action, Message, Service

__all__ = [
    "BatteryState",
    "CameraInfo",
    "ChannelFloat32",
    "CompressedImage",
    "FluidPressure",
    "Illuminance",
    "Image",
    "Imu",
    "JointState",
    "Joy",
    "JoyFeedback",
    "JoyFeedbackArray",
    "LaserEcho",
    "LaserScan",
    "MagneticField",
    "MultiDOFJointState",
    "MultiEchoLaserScan",
    "NavSatFix",
    "NavSatStatus",
    "PointCloud",
    "PointCloud2",
    "PointField",
    "Range",
    "RegionOfInterest",
    "RelativeHumidity",
    "Temperature",
    "TimeReference",
]

class BatteryState(Message):
    POWER_SUPPLY_STATUS_UNKNOWN: ClassVar[int]
    POWER_SUPPLY_STATUS_CHARGING: ClassVar[int]
    POWER_SUPPLY_STATUS_DISCHARGING: ClassVar[int]
    POWER_SUPPLY_STATUS_NOT_CHARGING: ClassVar[int]
    POWER_SUPPLY_STATUS_FULL: ClassVar[int]
    POWER_SUPPLY_HEALTH_UNKNOWN: ClassVar[int]
    POWER_SUPPLY_HEALTH_GOOD: ClassVar[int]
    POWER_SUPPLY_HEALTH_OVERHEAT: ClassVar[int]
    POWER_SUPPLY_HEALTH_DEAD: ClassVar[int]
    POWER_SUPPLY_HEALTH_OVERVOLTAGE: ClassVar[int]
    POWER_SUPPLY_HEALTH_UNSPEC_FAILURE: ClassVar[int]
    POWER_SUPPLY_HEALTH_COLD: ClassVar[int]
    POWER_SUPPLY_HEALTH_WATCHDOG_TIMER_EXPIRE: ClassVar[int]
    POWER_SUPPLY_HEALTH_SAFETY_TIMER_EXPIRE: ClassVar[int]
    POWER_SUPPLY_TECHNOLOGY_UNKNOWN: ClassVar[int]
    POWER_SUPPLY_TECHNOLOGY_NIMH: ClassVar[int]
    POWER_SUPPLY_TECHNOLOGY_LION: ClassVar[int]
    POWER_SUPPLY_TECHNOLOGY_LIPO: ClassVar[int]
    POWER_SUPPLY_TECHNOLOGY_LIFE: ClassVar[int]
    POWER_SUPPLY_TECHNOLOGY_NICD: ClassVar[int]
    POWER_SUPPLY_TECHNOLOGY_LIMN: ClassVar[int]
    POWER_SUPPLY_TECHNOLOGY_TERNARY: ClassVar[int]
    POWER_SUPPLY_TECHNOLOGY_VRLA: ClassVar[int]
    header: std_msgs.msg.Header
    voltage: float
    temperature: float
    current: float
    charge: float
    capacity: float
    design_capacity: float
    percentage: float
    power_supply_status: int
    power_supply_health: int
    power_supply_technology: int
    present: bool
    @property
    def cell_voltage(self) -> array.array[float]: ...
    @cell_voltage.setter
    def cell_voltage(self, value: Iterable[float]) -> None: ...
    @property
    def cell_temperature(self) -> array.array[float]: ...
    @cell_temperature.setter
    def cell_temperature(self, value: Iterable[float]) -> None: ...
    location: str
    serial_number: str
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        voltage: float = ...,
        temperature: float = ...,
        current: float = ...,
        charge: float = ...,
        capacity: float = ...,
        design_capacity: float = ...,
        percentage: float = ...,
        power_supply_status: int = ...,
        power_supply_health: int = ...,
        power_supply_technology: int = ...,
        present: bool = ...,
        cell_voltage: Iterable[float] = ...,
        cell_temperature: Iterable[float] = ...,
        location: str = ...,
        serial_number: str = ...,
        check_fields: bool = ...,
    ) -> None: ...

class CameraInfo(Message):
    header: std_msgs.msg.Header
    height: int
    width: int
    distortion_model: str
    @property
    def d(self) -> array.array[float]: ...
    @d.setter
    def d(self, value: Iterable[float]) -> None: ...
    @property
    def k(self) -> numpy.typing.NDArray[numpy.float64]: ...
    @k.setter
    def k(self, value: Iterable[Any]) -> None: ...
    @property
    def r(self) -> numpy.typing.NDArray[numpy.float64]: ...
    @r.setter
    def r(self, value: Iterable[Any]) -> None: ...
    @property
    def p(self) -> numpy.typing.NDArray[numpy.float64]: ...
    @p.setter
    def p(self, value: Iterable[Any]) -> None: ...
    binning_x: int
    binning_y: int
    roi: RegionOfInterest
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        height: int = ...,
        width: int = ...,
        distortion_model: str = ...,
        d: Iterable[float] = ...,
        k: Iterable[Any] = ...,
        r: Iterable[Any] = ...,
        p: Iterable[Any] = ...,
        binning_x: int = ...,
        binning_y: int = ...,
        roi: RegionOfInterest = ...,
        check_fields: bool = ...,
    ) -> None: ...

class ChannelFloat32(Message):
    name: str
    @property
    def values(self) -> array.array[float]: ...
    @values.setter
    def values(self, value: Iterable[float]) -> None: ...
    def __init__(
        self,
        *,
        name: str = ...,
        values: Iterable[float] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class CompressedImage(Message):
    header: std_msgs.msg.Header
    format: str
    @property
    def data(self) -> array.array[int]: ...
    @data.setter
    def data(self, value: Iterable[int]) -> None: ...
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        format: str = ...,
        data: Iterable[int] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class FluidPressure(Message):
    header: std_msgs.msg.Header
    fluid_pressure: float
    variance: float
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        fluid_pressure: float = ...,
        variance: float = ...,
        check_fields: bool = ...,
    ) -> None: ...

class Illuminance(Message):
    header: std_msgs.msg.Header
    illuminance: float
    variance: float
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        illuminance: float = ...,
        variance: float = ...,
        check_fields: bool = ...,
    ) -> None: ...

class Image(Message):
    header: std_msgs.msg.Header
    height: int
    width: int
    encoding: str
    is_bigendian: int
    step: int
    @property
    def data(self) -> array.array[int]: ...
    @data.setter
    def data(self, value: Iterable[int]) -> None: ...
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        height: int = ...,
        width: int = ...,
        encoding: str = ...,
        is_bigendian: int = ...,
        step: int = ...,
        data: Iterable[int] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class Imu(Message):
    header: std_msgs.msg.Header
    orientation: geometry_msgs.msg.Quaternion
    @property
    def orientation_covariance(self) -> numpy.typing.NDArray[numpy.float64]: ...
    @orientation_covariance.setter
    def orientation_covariance(self, value: Iterable[Any]) -> None: ...
    angular_velocity: geometry_msgs.msg.Vector3
    @property
    def angular_velocity_covariance(self) -> numpy.typing.NDArray[numpy.float64]: ...
    @angular_velocity_covariance.setter
    def angular_velocity_covariance(self, value: Iterable[Any]) -> None: ...
    linear_acceleration: geometry_msgs.msg.Vector3
    @property
    def linear_acceleration_covariance(self) -> numpy.typing.NDArray[numpy.float64]: ...
    @linear_acceleration_covariance.setter
    def linear_acceleration_covariance(self, value: Iterable[Any]) -> None: ...
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        orientation: geometry_msgs.msg.Quaternion = ...,
        orientation_covariance: Iterable[Any] = ...,
        angular_velocity: geometry_msgs.msg.Vector3 = ...,
        angular_velocity_covariance: Iterable[Any] = ...,
        linear_acceleration: geometry_msgs.msg.Vector3 = ...,
        linear_acceleration_covariance: Iterable[Any] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class JointState(Message):
    header: std_msgs.msg.Header
    name: list[str]
    @property
    def position(self) -> array.array[float]: ...
    @position.setter
    def position(self, value: Iterable[float]) -> None: ...
    @property
    def velocity(self) -> array.array[float]: ...
    @velocity.setter
    def velocity(self, value: Iterable[float]) -> None: ...
    @property
    def effort(self) -> array.array[float]: ...
    @effort.setter
    def effort(self, value: Iterable[float]) -> None: ...
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        name: list[str] = ...,
        position: Iterable[float] = ...,
        velocity: Iterable[float] = ...,
        effort: Iterable[float] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class Joy(Message):
    header: std_msgs.msg.Header
    @property
    def axes(self) -> array.array[float]: ...
    @axes.setter
    def axes(self, value: Iterable[float]) -> None: ...
    @property
    def buttons(self) -> array.array[int]: ...
    @buttons.setter
    def buttons(self, value: Iterable[int]) -> None: ...
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        axes: Iterable[float] = ...,
        buttons: Iterable[int] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class JoyFeedback(Message):
    TYPE_LED: ClassVar[int]
    TYPE_RUMBLE: ClassVar[int]
    TYPE_BUZZER: ClassVar[int]
    type: int
    id: int
    intensity: float
    def __init__(
        self,
        *,
        type: int = ...,
        id: int = ...,
        intensity: float = ...,
        check_fields: bool = ...,
    ) -> None: ...

class JoyFeedbackArray(Message):
    array: list[JoyFeedback]
    def __init__(self, *, array: list[JoyFeedback] = ..., check_fields: bool = ...) -> None: ...

class LaserEcho(Message):
    @property
    def echoes(self) -> array.array[float]: ...
    @echoes.setter
    def echoes(self, value: Iterable[float]) -> None: ...
    def __init__(self, *, echoes: Iterable[float] = ..., check_fields: bool = ...) -> None: ...

class LaserScan(Message):
    header: std_msgs.msg.Header
    angle_min: float
    angle_max: float
    angle_increment: float
    time_increment: float
    scan_time: float
    range_min: float
    range_max: float
    @property
    def ranges(self) -> array.array[float]: ...
    @ranges.setter
    def ranges(self, value: Iterable[float]) -> None: ...
    @property
    def intensities(self) -> array.array[float]: ...
    @intensities.setter
    def intensities(self, value: Iterable[float]) -> None: ...
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        angle_min: float = ...,
        angle_max: float = ...,
        angle_increment: float = ...,
        time_increment: float = ...,
        scan_time: float = ...,
        range_min: float = ...,
        range_max: float = ...,
        ranges: Iterable[float] = ...,
        intensities: Iterable[float] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class MagneticField(Message):
    header: std_msgs.msg.Header
    magnetic_field: geometry_msgs.msg.Vector3
    @property
    def magnetic_field_covariance(self) -> numpy.typing.NDArray[numpy.float64]: ...
    @magnetic_field_covariance.setter
    def magnetic_field_covariance(self, value: Iterable[Any]) -> None: ...
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        magnetic_field: geometry_msgs.msg.Vector3 = ...,
        magnetic_field_covariance: Iterable[Any] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class MultiDOFJointState(Message):
    header: std_msgs.msg.Header
    joint_names: list[str]
    transforms: list[geometry_msgs.msg.Transform]
    twist: list[geometry_msgs.msg.Twist]
    wrench: list[geometry_msgs.msg.Wrench]
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        joint_names: list[str] = ...,
        transforms: list[geometry_msgs.msg.Transform] = ...,
        twist: list[geometry_msgs.msg.Twist] = ...,
        wrench: list[geometry_msgs.msg.Wrench] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class MultiEchoLaserScan(Message):
    header: std_msgs.msg.Header
    angle_min: float
    angle_max: float
    angle_increment: float
    time_increment: float
    scan_time: float
    range_min: float
    range_max: float
    ranges: list[LaserEcho]
    intensities: list[LaserEcho]
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        angle_min: float = ...,
        angle_max: float = ...,
        angle_increment: float = ...,
        time_increment: float = ...,
        scan_time: float = ...,
        range_min: float = ...,
        range_max: float = ...,
        ranges: list[LaserEcho] = ...,
        intensities: list[LaserEcho] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class NavSatFix(Message):
    COVARIANCE_TYPE_UNKNOWN: ClassVar[int]
    COVARIANCE_TYPE_APPROXIMATED: ClassVar[int]
    COVARIANCE_TYPE_DIAGONAL_KNOWN: ClassVar[int]
    COVARIANCE_TYPE_KNOWN: ClassVar[int]
    header: std_msgs.msg.Header
    status: NavSatStatus
    latitude: float
    longitude: float
    altitude: float
    @property
    def position_covariance(self) -> numpy.typing.NDArray[numpy.float64]: ...
    @position_covariance.setter
    def position_covariance(self, value: Iterable[Any]) -> None: ...
    position_covariance_type: int
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        status: NavSatStatus = ...,
        latitude: float = ...,
        longitude: float = ...,
        altitude: float = ...,
        position_covariance: Iterable[Any] = ...,
        position_covariance_type: int = ...,
        check_fields: bool = ...,
    ) -> None: ...

class NavSatStatus(Message):
    STATUS_UNKNOWN: ClassVar[int]
    STATUS_NO_FIX: ClassVar[int]
    STATUS_FIX: ClassVar[int]
    STATUS_SBAS_FIX: ClassVar[int]
    STATUS_GBAS_FIX: ClassVar[int]
    SERVICE_UNKNOWN: ClassVar[int]
    SERVICE_GPS: ClassVar[int]
    SERVICE_GLONASS: ClassVar[int]
    SERVICE_COMPASS: ClassVar[int]
    SERVICE_GALILEO: ClassVar[int]
    status: int
    service: int
    def __init__(
        self,
        *,
        status: int = ...,
        service: int = ...,
        check_fields: bool = ...,
    ) -> None: ...

class PointCloud(Message):
    header: std_msgs.msg.Header
    points: list[geometry_msgs.msg.Point32]
    channels: list[ChannelFloat32]
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        points: list[geometry_msgs.msg.Point32] = ...,
        channels: list[ChannelFloat32] = ...,
        check_fields: bool = ...,
    ) -> None: ...

class PointCloud2(Message):
    header: std_msgs.msg.Header
    height: int
    width: int
    fields: list[PointField]
    is_bigendian: bool
    point_step: int
    row_step: int
    @property
    def data(self) -> array.array[int]: ...
    @data.setter
    def data(self, value: Iterable[int]) -> None: ...
    is_dense: bool
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        height: int = ...,
        width: int = ...,
        fields: list[PointField] = ...,
        is_bigendian: bool = ...,
        point_step: int = ...,
        row_step: int = ...,
        data: Iterable[int] = ...,
        is_dense: bool = ...,
        check_fields: bool = ...,
    ) -> None: ...

class PointField(Message):
    INT8: ClassVar[int]
    UINT8: ClassVar[int]
    INT16: ClassVar[int]
    UINT16: ClassVar[int]
    INT32: ClassVar[int]
    UINT32: ClassVar[int]
    FLOAT32: ClassVar[int]
    FLOAT64: ClassVar[int]
    name: str
    offset: int
    datatype: int
    count: int
    def __init__(
        self,
        *,
        name: str = ...,
        offset: int = ...,
        datatype: int = ...,
        count: int = ...,
        check_fields: bool = ...,
    ) -> None: ...

class Range(Message):
    ULTRASOUND: ClassVar[int]
    INFRARED: ClassVar[int]
    header: std_msgs.msg.Header
    radiation_type: int
    field_of_view: float
    min_range: float
    max_range: float
    range: float
    variance: float
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        radiation_type: int = ...,
        field_of_view: float = ...,
        min_range: float = ...,
        max_range: float = ...,
        range: float = ...,
        variance: float = ...,
        check_fields: bool = ...,
    ) -> None: ...

class RegionOfInterest(Message):
    x_offset: int
    y_offset: int
    height: int
    width: int
    do_rectify: bool
    def __init__(
        self,
        *,
        x_offset: int = ...,
        y_offset: int = ...,
        height: int = ...,
        width: int = ...,
        do_rectify: bool = ...,
        check_fields: bool = ...,
    ) -> None: ...

class RelativeHumidity(Message):
    header: std_msgs.msg.Header
    relative_humidity: float
    variance: float
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        relative_humidity: float = ...,
        variance: float = ...,
        check_fields: bool = ...,
    ) -> None: ...

class Temperature(Message):
    header: std_msgs.msg.Header
    temperature: float
    variance: float
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        temperature: float = ...,
        variance: float = ...,
        check_fields: bool = ...,
    ) -> None: ...

class TimeReference(Message):
    header: std_msgs.msg.Header
    time_ref: builtin_interfaces.msg.Time
    source: str
    def __init__(
        self,
        *,
        header: std_msgs.msg.Header = ...,
        time_ref: builtin_interfaces.msg.Time = ...,
        source: str = ...,
        check_fields: bool = ...,
    ) -> None: ...
