"""Million directions a second of one thread that NumPy looks up in a map of light, as integrands/map.h does:
bilinear, rows by the angle to +z. Where NumPy is: python3 bench/integrands/lookups.py"""

import time

import numpy as np

WIDTH, HEIGHT, NUM, REPEATS = 1024, 512, 131072, 15


def look_up(rows, u):
    number = rows.dtype.type
    theta = np.arctan2(np.hypot(u[:, 0], u[:, 1]), u[:, 2])
    down = np.clip(theta * number(HEIGHT / np.pi) + number(0.5), 0, number(HEIGHT + 1))
    row = np.minimum(down.astype(np.int32), HEIGHT)
    below = down - row
    across = np.arctan2(u[:, 1], u[:, 0]) * number(WIDTH / (2 * np.pi)) - number(0.5)
    across = np.where(across < 0, across + number(WIDTH), across)
    column = across.astype(np.int32)
    right = across - column
    column %= WIDTH
    beside = (column + 1) % WIDTH
    pixels, begin = rows.ravel(), row * WIDTH
    upper = (1 - right) * pixels[begin + column] + right * pixels[begin + beside]
    begin += WIDTH
    lower = (1 - right) * pixels[begin + column] + right * pixels[begin + beside]
    return (1 - below) * upper + below * lower


def main():
    random = np.random.default_rng(1)
    image = random.random((HEIGHT, WIDTH))
    poles = [np.full((1, WIDTH), line.mean()) for line in (image[0], image[-1])]
    rows = np.vstack([poles[0], image, poles[1]])
    u = random.normal(size=(NUM, 3))
    u /= np.linalg.norm(u, axis=1, keepdims=True)
    for number in (np.float32, np.float64):
        own_rows, own_u, seconds = rows.astype(number), u.astype(number), []
        for _ in range(REPEATS):
            start = time.process_time()
            look_up(own_rows, own_u)
            seconds.append(time.process_time() - start)
        print(f"{number.__name__}: {1e-6 * NUM / np.median(seconds):.1f}")


main()
