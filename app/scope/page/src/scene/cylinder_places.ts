/// Where a cylinder's barrel, piston and rod begin and end.

export interface CylinderSize {
  bore_m: number;
  rod_m: number;
  closed_length_m: number;
  stroke_m: number;
}

/// Places along the cylinder from its base pin, m, in the right order for any stroke.
export interface CylinderPlaces {
  cap_m: number;     ///< Where the barrel begins.
  piston_m: number;
  gland_m: number;   ///< Where the barrel ends and the rod comes out.
  eye_m: number;     ///< Rod eye's pin.
}

/// What of the closed length is no barrel (eyes at both ends) goes to cap and rod eye alike; the
/// piston is at the cap when closed and at the gland when fully out.
export function cylinder_places(size: CylinderSize, length_m: number): CylinderPlaces {
  const spare = Math.max(0, size.closed_length_m - size.stroke_m);
  const cap = 0.3 * spare;
  const gland = size.closed_length_m - Math.min(0.3 * spare, 0.2);
  const stroke = Math.min(Math.max(length_m - size.closed_length_m, 0), size.stroke_m);
  const share = size.stroke_m > 0 ? stroke / size.stroke_m : 0;
  return {
    cap_m: cap, piston_m: cap + 0.06 + share * (gland - cap - 0.1), gland_m: gland,
    eye_m: length_m};
}
