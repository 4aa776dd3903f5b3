import { Tableau } from "./tableau";

/** Kutta's method of order 3. */
export const kutta: Tableau = {
  A: [[], [1 / 2], [-1, 2]],
  b: [1 / 6, 2 / 3, 1 / 6],
  c: [0, 1 / 2, 1],
  order: 3,
};

export class Ralston extends Stepper {
  constructor() {
    super(2);
    this.A = [new Float64Array(2), new Float64Array(2)];
    this.A[1][0] = 2 / 3;
    this.b = Float64Array.from([1 / 4, 3 / 4]);
  }
  get order(): number {
    return 2;
  }
}
