// What part of the sea is seen: a centre in metres and pixels a metre, shared by all maps.

class Camera {
  constructor() {
    this.x = 0;
    this.y = 0;
    this.scale = 1;
    this.region = [0, 0, 1, 1];
  }

  /** Show a rectangle [west, south, east, north] on a map of so many pixels. */
  fit(region, width, height) {
    const [west, south, east, north] = region;
    this.region = region;
    this.x = (west + east) / 2;
    this.y = (south + north) / 2;
    this.scale = Math.min(
      width / Math.max(east - west, 1e-9),
      height / Math.max(north - south, 1e-9),
    );
  }

  zoomAt(factor, dx, dy) {
    const size = Math.max(this.region[2] - this.region[0], this.region[3] - this.region[1], 1e-9);
    const scale = Math.min(Math.max(this.scale * factor, 40 / size), 4e6 / size);
    const kept = 1 / this.scale - 1 / scale;
    this.x += dx * kept;
    this.y -= dy * kept;
    this.scale = scale;
  }

  /** Move what is seen by so many pixels. */
  pan(dx, dy) {
    this.x -= dx / this.scale;
    this.y += dy / this.scale;
  }

  /** Functions from metres to the pixels of a map, and back. */
  view(width, height) {
    const { x, y, scale } = this;
    return {
      scale,
      width,
      height,
      sx: (east) => width / 2 + (east - x) * scale,
      sy: (north) => height / 2 - (north - y) * scale,
      wx: (px) => x + (px - width / 2) / scale,
      wy: (py) => y - (py - height / 2) / scale,
    };
  }
}
