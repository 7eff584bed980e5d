// Colours: those of Okabe and Ito (2008) for AUVs, which colour-blind readers can tell apart, and
// quiet ramps for the current, so that whatever lies on them stands out.

const DASHES = [[], [9, 4], [2, 4], [9, 4, 2, 4]];

const THEMES = {
  light: {
    auvs: ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"],
    ramp: [
      [248, 251, 253],
      [221, 232, 241],
      [184, 205, 222],
      [141, 172, 198],
      [99, 136, 170],
    ],
    water: "#eef4f8",
    arrow: "rgba(38, 70, 100, 0.5)",
    land: "#d9cdb4",
    coast: "#9a8a66",
    obstacle: "#c8b8a8",
    noData: "#dfe3e7",
    ink: "#14202b",
    quiet: "#5d6b78",
    halo: "rgba(255, 255, 255, 0.92)",
    paper: "#ffffff",
    alarm: "#c1121f",
  },
  dark: {
    auvs: ["#3d9be0", "#f07d2b", "#12b98a", "#e29bc3", "#f2b134", "#8fd3ff", "#ffffff"],
    ramp: [
      [13, 22, 32],
      [19, 36, 52],
      [27, 53, 75],
      [39, 75, 103],
      [58, 103, 134],
    ],
    water: "#111c27",
    arrow: "rgba(176, 208, 232, 0.42)",
    land: "#4a4334",
    coast: "#8a7c5d",
    obstacle: "#5a4d43",
    noData: "#232c35",
    ink: "#e8eff5",
    quiet: "#94a5b4",
    halo: "rgba(8, 14, 20, 0.9)",
    paper: "#17222d",
    alarm: "#ff6b6b",
  },
};

function auvColour(theme, auv) {
  return theme.auvs[auv % theme.auvs.length];
}

/** Dashes tell apart AUVs that share a colour. */
function auvDash(theme, auv) {
  return DASHES[Math.floor(auv / theme.auvs.length) % DASHES.length];
}

/** Red, green and blue of a share from 0 to 1 along a ramp. */
function rampColour(ramp, share) {
  const place = Math.min(Math.max(share, 0), 1) * (ramp.length - 1);
  const low = Math.min(Math.floor(place), ramp.length - 2);
  return ramp[low].map((value, k) =>
    Math.round(value + (place - low) * (ramp[low + 1][k] - value)),
  );
}

function parseHex(hex) {
  return [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));
}
