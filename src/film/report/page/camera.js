// Where the eye is. View space has x to the right, y up and z toward the eye, as in the pictures of the film.

const matrix = {
  /** Of two rotations, by columns. */
  times(a, b) {
    const product = new Array(9);
    for (let column = 0; column < 3; column++)
      for (let row = 0; row < 3; row++)
        product[3 * column + row] = a[row] * b[3 * column] + a[3 + row] * b[3 * column + 1] + a[6 + row] * b[3 * column + 2];
    return product;
  },
  apply(a, [x, y, z]) {
    return [0, 1, 2].map((row) => a[row] * x + a[3 + row] * y + a[6 + row] * z);
  },
  /** About a unit vector. */
  about([x, y, z], angle) {
    const c = Math.cos(angle), s = Math.sin(angle), t = 1 - c;
    return [
      t * x * x + c, t * x * y + s * z, t * x * z - s * y,
      t * x * y - s * z, t * y * y + c, t * y * z + s * x,
      t * x * z + s * y, t * y * z - s * x, t * z * z + c,
    ];
  },
};

/** The camera of the film, and what the hand has made of it. */
class Camera {
  constructor() {
    this.reset();
  }

  /** As the film has it. */
  reset() {
    this.turned = [1, 0, 0, 0, 1, 0, 0, 0, 1];
    this.shifted = [0, 0];
    this.zoom = 1;
  }

  get isMoved() {
    return this.zoom !== 1 || this.shifted.some(Boolean) || this.turned.some((x, k) => x !== (k % 4 === 0 ? 1 : 0));
  }

  /** By angles to the right and up. */
  turn(right, up) {
    const angle = Math.hypot(right, up);
    if (angle > 0) this.turned = matrix.times(matrix.about([-up / angle, right / angle, 0], angle), this.turned);
  }

  /** About the axis of view. */
  roll(angle) {
    this.turned = matrix.times(matrix.about([0, 0, 1], angle), this.turned);
  }

  /** In parts of the height of the picture. */
  shift(right, up) {
    this.shifted[0] += right / this.zoom;
    this.shifted[1] += up / this.zoom;
  }

  magnify(factor) {
    this.zoom = Math.min(60, Math.max(0.2, this.zoom * factor));
  }

  /**
   * What the eye sees of a frame: rotation and shift to view space, half the height of the picture (its tangent with
   * perspective, else in lengths), and where the middle of the film is.
   */
  see(frame, aspect) {
    const { poses, perspective, center, radius } = facts.camera;
    const pose = poses[Math.min(frame, poses.length - 1)];
    const middle = matrix.apply(pose.turn, center).map((x, k) => x + pose.shift[k]);
    // A picture that is narrower than those of the film shows as much from side to side.
    const fit = Math.max(1, facts.camera.aspect / aspect);
    let half = pose.half * fit;
    const turn = matrix.times(this.turned, pose.turn);
    // Turned about the middle of the film.
    const shift = matrix.apply(this.turned, pose.shift.map((x, k) => x - middle[k])).map((x, k) => x + middle[k]);
    const far = perspective ? -middle[2] * half : half;
    shift[0] += 2 * far * this.shifted[0];
    shift[1] += 2 * far * this.shifted[1];
    half /= this.zoom;
    return { turn, shift, half, aspect, perspective, middle, radius, near: 1e-2 * radius, far: -middle[2] + 40 * radius };
  }
}
