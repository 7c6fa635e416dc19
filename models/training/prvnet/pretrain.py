"""Pre-trains a ConvNeXt-V2 on our own renders without labels; may be stopped and started again with the same command.

    python -m prvnet.pretrain --inputs DIR --encoder convnextv2_atto --size 128 --out runs/pretrain

Every object photographed counts, labelled or not, but for those that a run of the same --turn chooses by or holds out.
The folder gets config.json, log.csv, last.pt (to resume) and, in the end, encoder.pt, which
`prvnet.train --encoder-weights` starts from.
"""

import argparse
import csv
import json
import math
import time
from pathlib import Path

import numpy as np
import torch
from PIL import Image
from tqdm import tqdm

from . import MAX_IMAGES, augment, encoder_weights, encoders, labels
from .masked import PATCH, MaskedAutoencoder, random_mask
from .runs import save
from .sources import planes
from .splits import split

# Share of a crop's side that a training picture shows.
SHOWN = (0.5, 1.0)


def arguments(argv=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    add = parser.add_argument
    add("--inputs", type=Path, required=True, help="folder of `prv inputs`")
    add("--out", type=Path, required=True, help="folder of this run")
    add("--encoder", choices=encoders.CONVNEXT, default="convnextv2_atto")
    add("--size", type=int, default=128, help=f"side of the pictures, pixels, a multiple of {PATCH}")
    add("--mask", type=float, default=0.6, help="share of the patches hidden")
    add("--decoder-width", type=int, default=256)
    add("--epochs", type=int, default=40, help="passes over all crops")
    add("--batch", type=int, default=64)
    add("--lr", type=float, default=1e-3, help="at the given batch")
    add("--weight-decay", type=float, default=0.05)
    add("--turn", type=int, default=0, help="which folds are never seen: those that runs of this turn hold out or choose by")
    add("--seed", type=int, default=0)
    add("--threads", type=int, default=2)
    add("--device", default="cuda" if torch.cuda.is_available() else "cpu")
    args = parser.parse_args(argv)
    if args.size < 2 * PATCH or args.size % PATCH:
        parser.error(f"--size {args.size} must be a multiple of {PATCH}, and at least {2 * PATCH}")
    if not 0 < args.mask < 1:
        parser.error(f"--mask {args.mask} must lie between 0 and 1")
    return args


def picture(crop: Image.Image, size: int, rng: np.random.Generator) -> np.ndarray:
    """A random part of a square RGBA crop, at a random shoot's light and background: [size, size, 3] in 0..1."""
    side = crop.width
    shown = side * rng.uniform(*SHOWN)
    left, top = rng.uniform(0, side - shown, 2)
    image = crop.convert("RGBa")
    if rng.random() < 0.5:
        image = image.transpose(Image.Transpose.FLIP_LEFT_RIGHT)
    part = image.resize((size, size), Image.Resampling.BILINEAR, (left, top, left + shown, top + shown))
    return augment.shoot(np.asarray(part.convert("RGBA"))[None], rng)[0]


def configuration(args, rows) -> dict:
    """Everything that fixes the run's result."""
    chosen = ("encoder", "size", "mask", "decoder_width", "epochs", "batch", "lr", "weight_decay", "turn", "seed")
    return {**{key: getattr(args, key) for key in chosen}, "rows": [row.id for row in rows]}


def epoch_of(model, paths, args, epoch, optimizer, device) -> float:
    """One pass; all randomness comes from the seed and the epoch, so that a resumed run is the same run."""
    rng = np.random.default_rng([args.seed, epoch])
    generator = torch.Generator().manual_seed(args.seed * 100003 + epoch)
    order, total = rng.permutation(len(paths)), 0.0
    steps = -(-len(order) // args.batch)
    model.train()
    for step in tqdm(range(steps), f"epoch {epoch + 1}", leave=False):
        part = order[step * args.batch : (step + 1) * args.batch]
        images = planes(np.stack([picture(Image.open(paths[i]).convert("RGBA"), args.size, rng) for i in part])).to(device)
        mask = random_mask(len(part), args.size, args.mask, generator).to(device)
        for group in optimizer.param_groups:
            group["lr"] = args.lr * warm_cosine((epoch * steps + step + 1) / (args.epochs * steps))
        loss = model(images, mask)
        optimizer.zero_grad(set_to_none=True)
        loss.backward()
        torch.nn.utils.clip_grad_norm_(model.parameters(), 5.0)
        optimizer.step()
        total += float(loss.detach()) * len(part)
    return total / len(order)


def warm_cosine(progress: float, warm: float = 0.05) -> float:
    """Share of the learning rate at `progress`, 0 to 1, through the training."""
    return min(progress / warm, 0.5 + 0.5 * math.cos(math.pi * progress))


def pretrain(args) -> Path:
    """Path of encoder.pt."""
    rows = split(labels.photographed(args.inputs), args.turn)[0]
    if not rows:
        raise SystemExit(f"{args.inputs}: every object is held out of turn {args.turn}")
    config, finished = configuration(args, rows), args.out / encoder_weights.FILE
    args.out.mkdir(parents=True, exist_ok=True)
    known = args.out / "config.json"
    if known.is_file() and json.loads(known.read_text()) != config:
        raise SystemExit(f"{args.out} holds a run with other settings or inputs; give another --out")
    known.write_text(json.dumps(config, indent=1))
    if finished.is_file():
        return finished

    torch.set_num_threads(args.threads)
    torch.manual_seed(args.seed)
    device = torch.device(args.device)
    encoder = encoders.make(args.encoder, args.size)
    model = MaskedAutoencoder(encoder, args.decoder_width).to(device)
    # Biases, normalisations and the like are not decayed.
    decayed = [p for p in model.parameters() if p.squeeze().ndim > 1]
    others = [p for p in model.parameters() if p.squeeze().ndim <= 1]
    groups = [{"params": decayed, "weight_decay": args.weight_decay}, {"params": others, "weight_decay": 0.0}]
    optimizer = torch.optim.AdamW(groups, betas=(0.9, 0.95))
    last, log, first_epoch = args.out / "last.pt", args.out / "log.csv", 0
    if last.is_file():
        state = torch.load(last, map_location=device, weights_only=True)
        model.load_state_dict(state["weights"])
        optimizer.load_state_dict(state["optimizer"])
        first_epoch = state["epoch"]
    if first_epoch == 0 or not log.is_file():
        log.write_text("epoch,loss,cpu_s\n")
    paths = [args.inputs / row.id / f"{k}.png" for row in rows for k in range(MAX_IMAGES)]
    print(f"{len(paths)} crops of {len({row.group for row in rows})} objects; painting each hidden patch in its own "
          "mean grey gives a loss of at most 1")
    bar = tqdm(range(first_epoch, args.epochs), initial=first_epoch, total=args.epochs, unit="epoch")
    for epoch in bar:
        begin = time.process_time()
        loss = epoch_of(model, paths, args, epoch, optimizer, device)
        with open(log, "a", newline="") as file:
            csv.writer(file).writerow([epoch + 1, f"{loss:.5f}", f"{time.process_time() - begin:.2f}"])
        save({"weights": model.state_dict(), "optimizer": optimizer.state_dict(), "epoch": epoch + 1}, last)
        bar.set_postfix(loss=f"{loss:.4f}")
    weights = {key: value.cpu() for key, value in encoder.net.state_dict().items()}
    groups = sorted({row.group for row in rows})
    save({"encoder": args.encoder, "weights": weights, "groups": groups}, finished)
    return finished


def main(argv=None):
    path = pretrain(arguments(argv))
    print(f"{path}: {encoders.fingerprint(encoder_weights.read(path)['weights'])}")


if __name__ == "__main__":
    main()
