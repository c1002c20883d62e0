"""Images as arrays and back; expected grays are OpenCV's."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cv_bridge import CvBridge, CvBridgeError
from sensor_msgs.msg import CompressedImage, Image
from std_msgs.msg import Header

BRIDGE = CvBridge()
PIXELS = np.array([[[1, 2, 3], [10, 200, 30]], [[255, 255, 255], [90, 0, 250]]], np.uint8)
GRAY = np.array([[2, 128], [255, 85]], np.uint8)
DEPTHS = {
    "8U": "uint8",
    "8S": "int8",
    "16U": "uint16",
    "16S": "int16",
    "32S": "int32",
    "32F": "float32",
    "64F": "float64",
}


@pytest.mark.parametrize("channels", [1, 2, 3, 4])
@pytest.mark.parametrize(("name", "dtype"), DEPTHS.items())
def test_every_type_goes_there_and_back(name, dtype, channels):
    shape = (3, 5) if channels == 1 else (3, 5, channels)
    array = np.arange(np.prod(shape)).reshape(shape).astype(dtype)
    message = BRIDGE.cv2_to_imgmsg(array, header=Header(frame_id="camera"))
    assert message.encoding == f"{name}C{channels}"
    assert (message.height, message.width, message.step) == (3, 5, 5 * channels * array.itemsize)
    assert message.header.frame_id == "camera"
    back = BRIDGE.imgmsg_to_cv2(message)
    assert back.dtype == array.dtype
    assert np.array_equal(back, array)
    assert BRIDGE.encoding_to_dtype_with_channels(message.encoding) == (dtype, channels)
    number = BRIDGE.encoding_to_cvtype2(message.encoding)
    assert BRIDGE.cvtype_to_name[number] == f"CV_{name}C{channels}"
    assert BRIDGE.cvtype2_to_dtype_with_channels(number) == (dtype, channels)
    assert BRIDGE.cvtype2_to_dtype_with_channels(f"CV_{name}C{channels}") == (dtype, channels)
    assert BRIDGE.dtype_with_channels_to_cvtype2(dtype, channels) == f"{name}C{channels}"


def test_numbers_of_types_are_those_of_opencv():
    numbers = {"mono8": 0, "bgr8": 16, "rgba8": 24, "mono16": 2, "rgb16": 18, "32FC1": 5}
    assert {name: BRIDGE.encoding_to_cvtype2(name) for name in numbers} == numbers


@pytest.mark.parametrize(
    ("encoding", "array", "wanted", "expected"),
    [
        ("bgr8", PIXELS, "rgb8", PIXELS[..., ::-1]),
        ("bgr8", PIXELS, "passthrough", PIXELS),
        ("bgr8", PIXELS, "8UC3", PIXELS),
        ("bgr8", PIXELS, "mono8", GRAY),
        ("rgb8", PIXELS[..., ::-1], "mono8", GRAY),
        ("bgr8", PIXELS, "mono16", GRAY * np.uint16(257)),
        ("mono8", GRAY, "bgr8", np.dstack([GRAY] * 3)),
        ("mono8", GRAY, "rgba8", np.dstack([GRAY] * 3 + [np.full_like(GRAY, 255)])),
        ("bgr8", PIXELS, "bgra8", np.dstack([PIXELS, np.full_like(GRAY, 255)])),
        ("bgra8", np.dstack([PIXELS, GRAY]), "rgba8", np.dstack([PIXELS[..., ::-1], GRAY])),
        ("mono16", np.array([[0, 128, 129, 65535]], np.uint16), "mono8", [[0, 0, 1, 255]]),
        ("16UC1", np.array([[700]], np.uint16), "mono16", [[700]]),
        ("16UC1", np.array([[700]], np.uint16), "32FC1", [[700.0]]),
        ("32FC1", np.array([[-2.0, 0.6, 300.0]], np.float32), "mono8", [[0, 1, 255]]),
    ],
)
def test_colors_and_depths(encoding, array, wanted, expected):
    found = BRIDGE.imgmsg_to_cv2(BRIDGE.cv2_to_imgmsg(array, encoding), wanted)
    assert np.array_equal(found, np.array(expected))


def test_rows_with_padding_and_big_endian_numbers():
    message = Image(height=2, width=2, encoding="mono16", is_bigendian=1, step=6)
    message.data = bytes([1, 0, 0, 2, 9, 9, 3, 0, 0, 4])  # the last row may lack the padding
    assert BRIDGE.imgmsg_to_cv2(message).tolist() == [[256, 2], [768, 4]]
    assert BRIDGE.cv2_to_imgmsg(np.array([[1]], ">u2")).is_bigendian == 1


def test_an_image_without_pixels():
    message = BRIDGE.cv2_to_imgmsg(np.zeros((0, 4, 3), np.uint8), "bgr8")
    assert (message.height, message.width, message.step) == (0, 4, 0)


@pytest.mark.parametrize(
    ("message", "wanted", "error"),
    [
        (Image(encoding="mono9"), "mono8", r"Unrecognized image encoding \[mono9\]"),
        (Image(encoding="mono8"), "grey", r"Unrecognized image encoding \[grey\]"),
        (Image(encoding="mono8", height=2, width=3, step=3, data=b"12345"), "mono8",
            "2 rows of 3 pixels in mono8 need 6 bytes, and the message has 5, with 3 in each row"),
        (Image(encoding="mono8", height=1, width=3, step=2, data=b"123"), "mono8", "with 2 in"),
        (Image(encoding="16UC1", height=1, width=1, step=2, data=b"12"), "bgr8",
            "cannot convert 1 channels to 3 without color spaces"),
    ],
)  # fmt: skip
def test_messages_that_cannot_be_converted(message, wanted, error):
    with pytest.raises(CvBridgeError, match=error):
        BRIDGE.imgmsg_to_cv2(message, wanted)


@pytest.mark.parametrize(
    ("array", "encoding", "error"),
    [
        ([[1]], "mono8", "Your input type is not a numpy array"),
        (np.zeros(3, np.uint8), "mono8", "expected an image, got an array of 1 dimensions"),
        (np.zeros((1, 1), complex), "mono8", "and type complex128"),
        (PIXELS, "mono8",
            "encoding specified as mono8, but image has incompatible type 8UC3"),
        (PIXELS, "rgb9", r"Unrecognized image encoding \[rgb9\]"),
    ],
)  # fmt: skip
def test_arrays_that_cannot_be_converted(array, encoding, error):
    with pytest.raises(CvBridgeError, match=error):
        BRIDGE.cv2_to_imgmsg(array, encoding)


@pytest.mark.parametrize("encoding", ["bayer_rggb8", "yuv422", "nv21"])
def test_encodings_that_need_opencv_name_it_in_the_error(monkeypatch, encoding):
    monkeypatch.setitem(__import__("sys").modules, "cv2", None)
    message = Image(height=2, width=2, encoding=encoding, step=4, data=bytes(16))
    with pytest.raises(CvBridgeError, match="needs OpenCV: pip install opencv-python-headless"):
        BRIDGE.imgmsg_to_cv2(message, "bgr8")
    with pytest.raises(CvBridgeError, match="compressed images need OpenCV"):
        BRIDGE.compressed_imgmsg_to_cv2(CompressedImage(format="png"))
    with pytest.raises(CvBridgeError, match="compressed images need OpenCV"):
        BRIDGE.cv2_to_compressed_imgmsg(PIXELS)


@given(st.binary(min_size=48, max_size=48), st.sampled_from(["bgr", "rgb", "bgra", "rgba"]))
def test_opencv_finds_the_same_colors(data, space):
    cv2 = pytest.importorskip("cv2")
    array = np.frombuffer(data, np.uint8).reshape(-1, 2, len(space))
    for target in ("mono", "bgr", "rgb", "bgra", "rgba"):
        if target == space:
            continue
        code = getattr(cv2, f"COLOR_{space.upper()}2{target.upper().replace('MONO', 'GRAY')}")
        found = BRIDGE.imgmsg_to_cv2(BRIDGE.cv2_to_imgmsg(array, f"{space}8"), f"{target}8")
        assert np.array_equal(found, cv2.cvtColor(array, code))


def test_compressed_images_with_opencv():
    pytest.importorskip("cv2")
    message = BRIDGE.cv2_to_compressed_imgmsg(PIXELS, "png")
    assert message.format == "png"
    assert np.array_equal(BRIDGE.compressed_imgmsg_to_cv2(message), PIXELS)
    assert np.array_equal(BRIDGE.compressed_imgmsg_to_cv2(message, "mono8"), GRAY)
    assert BRIDGE.cv2_to_compressed_imgmsg(PIXELS).data[:2].tobytes() == b"\xff\xd8"  # JPEG
    with pytest.raises(CvBridgeError, match="unknown format 'doc'"):
        BRIDGE.cv2_to_compressed_imgmsg(PIXELS, "doc")
    with pytest.raises(CvBridgeError, match="cannot decode a compressed image, 'png'"):
        BRIDGE.compressed_imgmsg_to_cv2(CompressedImage(format="png", data=b"no"))


@pytest.mark.parametrize(
    "encoding", ["bayer_rggb8", "bayer_bggr8", "bayer_gbrg8", "bayer_grbg8", "uyvy", "yuyv", "nv21"]
)
def test_camera_encodings_with_opencv(encoding):
    pytest.importorskip("cv2")
    # A gray of 128 is the same in all these encodings.
    step = 16 if encoding in ("uyvy", "yuyv") else 8
    rows = 12 if encoding == "nv21" else 8
    message = Image(
        height=8, width=8, encoding=encoding, step=step, data=bytes([128]) * (rows * step)
    )
    image = BRIDGE.imgmsg_to_cv2(message, "bgr8")
    assert image.shape == (8, 8, 3)
    assert (image.max(), image.min()) in {(128, 128), (130, 130)}
