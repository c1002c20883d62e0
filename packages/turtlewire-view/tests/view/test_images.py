"""Pixels of each encoding, and pictures that are none."""

import numpy as np
import pytest

from turtlewire import msg
from turtlewire_view.displays.image import CompressedImageDisplay, ImageDisplay

PNG = bytes.fromhex("89504e470d0a1a0a0000000d49484452000000010000000108000000003a7e9b55")


def image(encoding, pixels, *, padding=0, big=False):
    """An Image of an array ``(height, width, bytes or numbers of a pixel)``."""
    message = msg.get_message("sensor_msgs/msg/Image")()
    pixels = np.asarray(pixels)
    message.height, message.width = pixels.shape[:2]
    message.encoding, message.is_bigendian = encoding, int(big)
    rows = [row.astype(pixels.dtype.newbyteorder(">" if big else "<")).tobytes() for row in pixels]
    message.step = len(rows[0]) + padding
    message.data = b"".join(row + bytes(padding) for row in rows)
    return msg.deserialize(type(message), msg.serialize(message))


def rgba(message, **options):
    content, status = ImageDisplay(options).content(message)
    assert status.level == "ok"
    assert content.frame_id is None
    return content.arrays["rgba"].tolist()


@pytest.mark.parametrize(
    ("encoding", "pixel"),
    [
        ("rgb8", [10, 20, 30]),
        ("bgr8", [30, 20, 10]),
        ("8UC3", [30, 20, 10]),
        ("rgba8", [10, 20, 30, 255]),
        ("bgra8", [30, 20, 10, 255]),
        ("8UC4", [30, 20, 10, 255]),
    ],
)
@pytest.mark.parametrize("padding", [0, 5])
def test_colors(encoding, pixel, padding):
    pixels = np.array([[pixel, pixel], [pixel, pixel]], np.uint8)
    assert rgba(image(encoding, pixels, padding=padding)) == [[[10, 20, 30, 255]] * 2] * 2


@pytest.mark.parametrize("big", [False, True])
def test_wide_colors_and_greys(big):
    assert rgba(image("rgb16", np.array([[[2560, 5120, 7680]]], "u2"), big=big)) == [
        [[10, 20, 30, 255]]
    ]
    assert rgba(image("mono16", np.array([[[0x1234]]], "u2"), big=big)) == [[[18, 18, 18, 255]]]
    depths = np.array([[[1000], [2000]]], "u2")
    assert rgba(image("16UC1", depths, big=big)) == [[[0, 0, 0, 255], [255, 255, 255, 255]]]
    metres = np.array([[[1.0], [np.nan], [3.0]]], "f4")
    assert [each[0] for each in rgba(image("32FC1", metres, big=big))[0]] == [0, 0, 255]
    fixed = rgba(image("32FC1", metres, big=big), normalize_range=False, min=0.0, max=2.0)
    assert [each[0] for each in fixed[0]] == [128, 0, 255]
    assert rgba(image("mono8", np.array([[[7]]], "u1"))) == [[[7, 7, 7, 255]]]


@pytest.mark.parametrize(
    ("encoding", "order"),
    [("yuv422", [128, 50, 128, 200]), ("uyvy", [128, 50, 128, 200]), ("yuyv", [50, 128, 200, 128])],
)
def test_yuv(encoding, order):
    pixels = np.array([[order[:2], order[2:]]], np.uint8)
    assert rgba(image(encoding, pixels)) == [[[50, 50, 50, 255], [200, 200, 200, 255]]]
    red = {"yuv422": [90, 76, 255, 76], "uyvy": [90, 76, 255, 76], "yuyv": [76, 90, 76, 255]}
    pixels = np.array([[red[encoding][:2], red[encoding][2:]]], np.uint8)
    level = rgba(image(encoding, pixels))[0][0]
    assert level[0] > 240
    assert max(level[1], level[2]) < 25


@pytest.mark.parametrize("pattern", ["rggb", "bggr", "gbrg", "grbg"])
def test_bayer(pattern):
    levels = {"r": 200, "g": 100, "b": 50}
    block = np.array([levels[each] for each in pattern], np.uint8).reshape(2, 2)
    pixels = np.tile(block, (2, 2))[..., None]
    assert rgba(image(f"bayer_{pattern}8", pixels)) == [[[200, 100, 50, 255]] * 2] * 2
    wide = pixels.astype("u2") * 256
    assert rgba(image(f"bayer_{pattern}16", wide)) == [[[200, 100, 50, 255]] * 2] * 2


def test_a_large_picture_is_made_coarser():
    pixels = np.zeros((10, 2000, 3), np.uint8)
    content, _ = ImageDisplay().content(image("rgb8", pixels))
    assert content.arrays["rgba"].shape == (4, 667, 4)
    assert content.header["width"] == 2000


@pytest.mark.parametrize(
    ("changes", "line"),
    [
        ({"encoding": "jpeg2000"}, "the encoding 'jpeg2000' is not supported; choose from rgb8"),
        ({"width": 5}, "step is 6, but a row of rgb8 needs 15"),
        ({"height": 9}, "2 x 9 pixels of rgb8 need 54 bytes, the image holds 12"),
        ({"width": 0}, "the image has no pixels: 0 x 2"),
        ({"width": 2**32 - 1, "height": 2**32 - 1}, "step is 6"),
        ({"encoding": "yuyv", "width": 1}, "yuyv needs two pixels in a row"),
    ],
)
def test_invalid_images(changes, line):
    message = image("rgb8", np.zeros((2, 2, 3), np.uint8))
    for name, value in changes.items():
        setattr(message, name, value)
    (status,) = ImageDisplay().content(message)
    assert (status.level, status.text[: len(line)]) == ("error", line)


def compressed(data, form="jpeg"):
    Message = msg.get_message("sensor_msgs/msg/CompressedImage")  # noqa: N806
    message = Message(format=form, data=data)
    return CompressedImageDisplay().content(msg.deserialize(Message, msg.serialize(message)))


def test_compressed_images_pass_through():
    content, status = compressed(b"\xff\xd8\xff\xe0rest")
    assert (content.header["media_type"], status.level) == ("image/jpeg", "ok")
    assert bytes(content.arrays["file"]) == b"\xff\xd8\xff\xe0rest"
    content, _ = compressed(PNG, "png")
    assert content.header["media_type"] == "image/png"
    content, _ = compressed(bytes(12) + PNG, "16UC1; compressedDepth png")
    assert bytes(content.arrays["file"]) == PNG


def test_files_that_are_no_pictures():
    (status,) = compressed(b"<svg onload=alert(1)>", "svg")
    assert status.text == "format 'svg': the 21 bytes are neither JPEG nor PNG"
    huge = PNG[:16] + (60_000).to_bytes(4, "big") * 2 + PNG[24:]
    (status,) = compressed(huge, "png")
    assert status.text == "a PNG of 60000 x 60000 pixels is too large"
