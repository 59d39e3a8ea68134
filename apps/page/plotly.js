// Plotly with the kinds of traces that the reports draw (scatter is in its core).
import Plotly from "plotly/core.js";
import bar from "plotly/bar.js";
import box from "plotly/box.js";
import contour from "plotly/contour.js";
import heatmap from "plotly/heatmap.js";
import histogram from "plotly/histogram.js";

Plotly.register([bar, box, contour, heatmap, histogram]);
export default Plotly;
