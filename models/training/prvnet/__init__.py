"""PRVNet: from one to five photos of an object to the number of views its reconstruction needs."""

import os

# Threads that wait without spinning: on a busy machine spinning makes every step many times slower.
os.environ.setdefault("OMP_WAIT_POLICY", "PASSIVE")

# Version of the model file's input, output and metadata; the service reads exactly this one.
FORMAT = "2"

# Half the side of the square window, metres, that `prv inputs` and the service cut out of a photo.
CROP_HALF_SIZE_M = 0.135

# The most photos of one object.
MAX_IMAGES = 5

# The service's initial photos (top, left, front): the first of the five that `prv inputs` writes.
INITIAL_IMAGES = 3

# View counts the paper's network can answer.
PAPER_RANGE = (13, 58)
