// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace episcope {

/// What a reader or a method says of data or of a result, as data. Notes and warnings travel and
/// are stored as English sentences that `finding_text` makes; `finding_of` gives back what was
/// said, for translations and for programs.
struct Finding {
  std::string code;                 ///< Among `kFindingTexts`.
  std::vector<std::string> values;  ///< As in the sentence, in its order.
  friend bool operator==(const Finding&, const Finding&) = default;
};

enum class FindingLevel { Warning, Note };

/// The sentence of a finding.
struct FindingText {
  std::string_view code;
  std::string_view english;  ///< With placeholders of fmt, without numbers.
  std::string_view brief{};  ///< For a line of a list: "%1" is the first value; empty = none.
  FindingLevel level =
      FindingLevel::Warning;  ///< A note tells what was done, of which all is well.
};

/// All sentences. Codes stay what they are: scripts read them.
inline constexpr auto kFindingTexts = std::to_array<FindingText>({
    // Runs of methods.
    {"run.gpu", "computed on {}"},
    {"run.cpu", "computed on the CPU: {}"},
    {"run.early", "ended early"},
    {"run.propagated", "propagated to all views from {} of them"},
    {"run.evened", "brightness of the views, which differs by up to {:.1f} %, was evened out"},
    {"run.weights", "weights of {}, hash {}"},
    {"gap", "largest relative duality gap {:.1e}"},
    {"labeling.done",
     "global labeling: λ {:.5g} per px, energy {:.6g}, gap {:.1e} after {} iterations"},
    {"labeling.early",
     "global labeling: λ {:.5g} per px, energy {:.6g}, gap {:.1e} after {} iterations (ended "
     "early)"},
    {"cuts.minimum", "K = {:.1f} (1/255)²; energy fell by {:.0f} K in {} cycles, to a minimum"},
    {"cuts.ended", "K = {:.1f} (1/255)²; energy fell by {:.0f} K in {} cycles"},
    {"ordering", "ordering violated by {:.3f} % of the lines, {:.3f} % before"},
    {"layers", "two layers in {:.1f} % of the pixels"},
    {"visibility", "visibility: {} of {} rounds"},
    {"cap.none", "matching cost uncapped"},
    {"cap", "matching cost capped at ε = {:.3f}"},
    // Ranges of disparity.
    {"range.found", "disparity range {:.2f} … {:.2f} px, found from the images"},
    {"range.stated",
     "The range searched, {:.2f} … {:.2f} px, does not hold all of the range that the light field "
     "states, {:.2f} … {:.2f} px"},
    {"range.elsewhere",
     "Nothing matches at disparities of {:.2f} … {:.2f} px: the images show {:.2f} … {:.2f} px; "
     "the range auto searches those",
     "Nothing matches in the range searched."},
    {"range.nothing",
     "Nothing matches between the views: the disparities, looked for within {:.2f} … {:.2f} px, "
     "are guesses",
     "Nothing matches between the views."},
    {"range.limited",
     "the disparity range found, {:.2f} … {:.2f} px, ends where the search does, at ±{:.2f} px: "
     "the "
     "scene may reach farther; give a range to search it"},
    // Positions of cameras.
    {"positions.used", "positions of cameras used, up to {:.2f} steps off the regular grid{}"},
    {"positions.no_better",
     "positions of cameras not used: up to {:.2f} steps off the regular grid{}, they match no "
     "better than the grid"},
    {"positions.no_grid", "positions of cameras not used: they make no grid"},
    {"positions.regular",
     "cameras stand up to {:.2f} steps off the regular grid, which this method takes for granted; "
     "net, plane_pm and stereo methods can use their positions"},
    // Numbers that a comparison with the truth lacks.
    {"missing.good",
     "{}: {:.2f} % of the pixels have no value and count as good pixels; means leave them out, as "
     "the 2016 tool does"},
    {"missing.all",
     "{}: {:.2f} % of the pixels have no value and count as the farthest true disparity, {:.3g} "
     "px: "
     "there is no other pixel"},
    {"missing.bad",
     "{}: {:.2f} % of the pixels have no value and count as the farthest true disparity, {:.3g} "
     "px: "
     "MSE×100 is {:.3g} with and {:.3g} without them"},
    // Brightness of views.
    {"brightness.off",
     "The brightness of the views differs by up to {:.1f} % (view {}: {:.3f}); without "
     "--no-equalize, methods even it out.",
     "Brightness differs by %1 %"},
    {"brightness.differs",
     "The brightness of the views differs by up to {:.1f} % (view {}: {:.3f}). Methods even it "
     "out; "
     "--equalize evens out the pictures, too, and --no-equalize leaves all as it is.",
     "Brightness differs by %1 %"},
    {"gain.same", "the same in all views"},
    {"gain.differs", "differs by up to {:.1f} % (view {}: {:.3f})"},
    {"gain.evened", "evened out; it differed by up to {:.1f} % (view {}: {:.3f})"},
    {"gain.clipped", "{:.2g} % of the samples clipped"},
    {"gain.little", "too little to even it out"},
    {"gain.unknown", "of {} views not known"},
    // Views and pixels that hold nothing.
    {"crop.dark",
     "Using the inner {} of {} views, rows {} to {} and columns {} to {} from 0: {} outer views "
     "are "
     "dark (mean {} % of the center's); --crop all keeps them.",
     "Using the inner %1 of %2 views; the outer ones are dark."},
    {"valid.dark",
     "{:.1f} % of all pixels, in {} of {} views, are dark where the center view is not; they are "
     "marked as not valid.",
     "%1 % of the pixels are dark and do not count."},
    {"valid.corners",
     "The corners of the views are black, {:.1f} % of their pixels, as a lens cuts them off; they "
     "are marked as not valid.",
     "Black corners (%1 %) do not count."},
    // Views that cannot be read, or are unlike the others; what follows are findings of their own.
    {"views.unusable", "{} cannot be used: {}. {}", "%1 cannot be used."},
    {"views.unusable_others", "Nor can {} other views. {}"},
    {"views.unlike", "this view has {}, but {} has {}"},
    {"exif.all",
     "All views state that they are stored {} (Exif orientation {}): they are shown upright, with "
     "rows and columns of pixels to match.",
     "The views were turned upright."},
    {"exif.film",
     "The film states that its pictures are stored {} (Exif orientation {}): they are shown "
     "upright, "
     "with rows and columns of pixels to match.",
     "The pictures of the film were turned upright."},
    {"exif.different",
     "The views state {} different orientations (Exif), {} of {} orientation {}: all are taken as "
     "they are stored; if the camera was turned, turn the pictures before.",
     "Orientations (Exif) differ."},
    {"exif.mirrored", "mirrored"},
    {"exif.half_turn", "turned by half"},
    {"exif.upside_down", "upside down and mirrored"},
    {"exif.turned_mirrored", "turned and mirrored"},
    {"exif.left", "turned by a quarter to the left"},
    {"exif.right", "turned by a quarter to the right"},
    // Samples.
    {"samples.bits",
     "No sample of the views exceeds {} of 65535: they are taken as samples of {} bits. --levels "
     "0,65535 keeps them as they are.",
     "Samples of %2 bits"},
    {"samples.signed",
     "Float samples of the views should lie in 0 … 1, but lie in {:.4g} … {:.4g}: {:.4g} … {:.4g} "
     "is taken as black to white ({}). --levels states other values.",
     "Black is taken at %3, white at %4"},
    {"samples.disparity",
     "These look like disparity maps of all views: their values are no colors. To judge them, run "
     "evaluate {} --truth INPUT, or put disparity into the name of the file.",
     "These look like disparity maps of all views"},
    {"samples.normalized", "normalized in some way: 0.1 % of them are darker, 0.1 % brighter"},
    {"samples.unit", "-1 for black, 1 for white"},
    {"samples.shifted_bytes", "bytes less 128"},
    {"samples.linear",
     "Float samples of the views reach up to {:.3g} with a median of {:.2g}: they are taken as "
     "linear, and divided by {:.4g} so that 99.9 % lie in 0 … 1.",
     "Linear samples, divided by %3"},
    {"samples.noise",
     "{:.2g} % of the float samples of the views lie clearly below 0, down to {:.2g}: they are "
     "taken as noise around black. --levels -1,1 would say otherwise.",
     "%1 % of the samples are negative"},
    {"samples.divided",
     "Float samples of the views should lie in 0 … 1, but reach up to {}; they are divided by {}.",
     "Samples are divided by %2"},
    {"samples.not_finite",
     "{} of {} samples of the views are NaN or infinite; their pixels do not count.",
     "%1 samples are NaN or infinite"},
    {"samples.y_cb_cr",
     "By its name {} holds Y, Cb and Cr: they were taken as those of {} and turned into colors.",
     "Y, Cb, Cr are turned into colors."},
    {"samples.fourth",
     "The fourth channel of {} is left out: it is no weight of pixels, for {}. If it is depth or "
     "disparity, store it as an array of its own, as disparity or depth.",
     "The fourth channel is left out."},
    // Cameras and views that are not where they should be.
    {"camera.unequal",
     "Rows of cameras are {:.3g} times as far apart as columns. net, plane_pm and stereo methods "
     "use the positions of the cameras; all others take both distances for equal, and their "
     "disparity is wrong: --crop 1x{} reads a single row of views for them.",
     "Rows of cameras are %1 times as far apart as columns."},
    {"camera.too_unequal",
     "Rows of cameras are {:.3g} times as far apart as columns, which no method takes into "
     "account: --crop 1x{} reads a single row of views.",
     "Rows of cameras are %1 times as far apart as columns."},
    {"views.same",
     "Views {} are one and the same picture, stored more than once: replace what is wrong.",
     "Views %1 are the same picture."},
    {"views.exchanged",
     "Views {} and {} seem to stand in each other's place: exchanged, they differ from their "
     "neighbors by {:.0f} % less. Rename or save them again in order.",
     "Views %1 and %2 seem to be exchanged."},
    {"views.snake",
     "Every second {} of views seems to be stored the other way round: turned round, it differs "
     "from its neighbors by {:.0f} % less. --snake reads images whose rows were captured back and "
     "forth; save other views again in order.",
     "Every second %1 of views seems to be reversed."},
    // Order of views; near and far.
    {"order.swapped", "Rows and columns of views seem to be swapped: {}.",
     "Rows and columns of views seem to be swapped."},
    {"order.chosen", "The order of views was chosen by hand ({}), but the check favors \"{}\".",
     "The check favors another order of views."},
    {"order.unexpected",
     "The order of views is \"{}\" and not \"{}\", which was expected because {}.",
     "Unexpected order of views: %1."},
    {"order.line",
     "Points move across the line of views as well: by {:.2f} px between views {} apart, beside "
     "{:.2f} px along it. This may be a film of a camera that zooms or turns, or views that are "
     "not rectified; disparity is not to be trusted then.",
     "Points move across the line of views as well."},
    {"order.slopes_agree",
     "checked by the slopes of horizontal and vertical EPIs: correlation {} as stored at {} "
     "points, "
     "so both axes agree"},
    {"order.slopes_differ",
     "checked by the slopes of horizontal and vertical EPIs: correlation {} as stored at {} "
     "points, "
     "so exactly one axis is reversed"},
    {"order.by_truth", "checked against the ground truth, mean grey error after warping: {}"},
    {"order.by_doubtful_truth",
     "by the ground truth, which is in doubt, mean grey error after warping: {}"},
    {"order.axis_errors", "{} {} (other way {}), {} {} (other way {})"},
    {"order.swapped_by_truth",
     "by the ground truth: mean grey error of neighboring views after warping {:.2f}, as stored "
     "{:.2f}"},
    {"order.by_occlusion", "checked by {}"},
    {"order.direction", "direction checked by {}"},
    {"order.of_pictures", "the pictures of a file do not say how they are ordered"},
    {"order.of_names", "rows and columns follow from the names"},
    {"order.of_poses", "the poses of the cameras say so"},
    {"order.of_mosaics", "mosaics hold rows and columns of views in order"},
    {"order.of_benchmark", "benchmark folders store views in canonical order"},
    {"order.of_arrays", "arrays do not say how their views are ordered"},
    {"order.single_view", "not checked (a single view)"},
    {"order.one_row", "not checked (one row of views)"},
    {"order.one_column", "not checked (one column of views)"},
    {"order.no_texture", "not checked (too little depth or texture)"},
    {"order.axes_unclear", "not checked (motion between views does not tell rows from columns)"},
    {"sign.occlusion", "occlusion: {} points to {}, in {} squares of the view to {}"},
    {"sign.by", "by occlusion: {} points to {}, in {} squares of the view to {}"},
    {"sign.by_truth", "by the ground truth: {}"},
    {"sign.by_poses", "by the camera poses, which define right and down"},
    {"sign.by_hand", "the order was chosen by hand"},
    {"sign.doubtful_truth", "the ground truth is in doubt"},
    {"sign.either",
     "the ground truth fits this order of views, and negated the opposite one; nothing tells which "
     "is "
     "right"},
    {"sign.few_views", "occlusion cannot be seen in fewer than three views in a row"},
    {"sign.larger_hide", "larger values are nearer: they {}"},
    {"sign.smaller_hide", "smaller values are nearer: they {}"},
    {"sign.larger", "larger values are nearer, by {}"},
    {"sign.smaller", "smaller values are nearer, by {}"},
    {"sign.hiding",
     "hide others in other views (grey error {:.2f}, the hidden ones {:.2f}, {} pairs)"},
    {"sign.by_order",
     "no depth edges tell near from far: the sign is the one that leaves the views in the order in "
     "which they are stored"},
    {"sign.no_edges", "no depth edges with clear occlusion: {} points for this order, {} against"},
    // Truth.
    {"truth.unchecked",
     "The values of the ground truth could not be checked: they explain the views no better than "
     "one disparity for all, or better in few places only (where both differ, in {} squares of "
     "the view, the truth leaves {:.0f} % of the error and is better by {:.1f} standard "
     "deviations of chance).",
     "The ground truth could not be checked."},
    {"truth.poor",
     "The ground truth hardly explains the views: warped by it, they differ by {} grey levels "
     "along "
     "{}, the other way by {} and unwarped by {}; check it, and dH, focalLength and shift if it "
     "was "
     "stored as depth.",
     "The ground truth hardly explains the views."},
    {"truth.turned",
     "The ground truth was stored with {}, as comparing it with the views shows; it was put right.",
     "The ground truth was turned."},
    {"truth.rows_reversed", "rows from bottom to top"},
    {"truth.columns_reversed", "columns from right to left"},
    {"truth.both_reversed", "both rows and columns in reverse order"},
    {"truth.transposed", "rows and columns exchanged"},
    {"truth.views_turned",
     "The {} of all views were stored in another order than the views ({}), as comparing them with "
     "views off the diagonal shows ({}); they were put right.",
     "The %1 of all views were reordered."},
    {"truth.maps", "maps of the ground truth"},
    {"truth.labels", "true labels"},
    {"truth.views_transposed", "rows and columns of views exchanged"},
    {"truth.views_misfit",
     "{:.3f} px off the map of the center view on the average, as stored {:.3f} px"},
    {"truth.views_jumps", "the disparity jumps by {:.2f} px at their edges, as stored by {:.2f}"},
    {"truth.views_contrast", "contrast at their edges {:.2f} grey levels, as stored {:.2f}"},
    {"labels.estimated", "The labels of this file are no ground truth: they were {}."},
    {"truth.estimated", "The depth of this file is no ground truth: it was {}.",
     "The depth of this file was estimated."},
    // Depth and its camera.
    {"depth.implausible",
     "The depth gives disparities of {} … {} px per view step, which is implausible; check dH, "
     "focalLength and shift of the file.",
     "Implausible depth: %1 … %2 px"},
    {"depth.camera_distance",
     "According to dH, focalLength and shift, disparity is zero at depth {}, but camDistance says "
     "{}; camDistance is ignored; check these attributes of the file.",
     "camDistance is ignored."},
    {"depth.no_camera_distance",
     "According to dH, focalLength and shift, disparity is zero at no finite depth, but "
     "camDistance "
     "says {}; camDistance is ignored; check these attributes of the file.",
     "camDistance is ignored."},
    {"depth.ignored", "{} is ignored because {}.", "%1 is ignored."},
    {"depth.no_layer",
     "{} is ignored because the other layer, {}, is missing or holds no depth; add it, or store a "
     "single layer as GT_DEPTH.",
     "%1 is ignored: one layer is missing."},
    {"depth.camera_unused", "The camera of the file is not used: {}.",
     "The camera of the file is not used."},
    {"depth.holes",
     "{} holds no depth at {:.3g} % of its pixels (masked, zero, negative or NaN); they are "
     "ignored.",
     "No depth at %2 % of the pixels of %1"},
    {"depth.by_warping", "this warps the views onto each other best ({} grey levels)"},
    // Maps beside views: their unit, and what is left out.
    {"map.unknown_value",
     "{} is {:.7g} at {:.3g} % of its pixels, which the views contradict ({}): no disparity is "
     "known there.",
     "%1 is unknown at %3 % of the pixels."},
    {"map.error_there", "grey error {:.2f} there, {:.2f} elsewhere"},
    {"map.leads_out", "it leads out of the picture"},
    {"map.unused",
     "{} is not used ({}): save disparity in px per view step as .npy, .pfm or float .tif.",
     "%1 is not used."},
    {"map.damaged", "{} of {} {} are left out. {}.", "%1 of %2 maps are left out."},
    {"map.exchanged",
     "{} with {}×{} px lie on their side beside views of {}×{} px: rows and columns were "
     "exchanged.",
     "%1 were turned."},
    {"map.mask_turned",
     "The disparity holds values only where its mask is 0: the mask is taken for one of missing "
     "values, as NumPy writes them.",
     "The mask marks missing values."},
    {"map.equal_names",
     "{} is taken for true and {} is not, though their names claim as much; rename or remove one "
     "of "
     "them if that is wrong.",
     "%1 is used, %2 is not."},
    {"map.computed_name",
     "{} is not taken for true, since its name is that of an estimate; call it gt_… if it is true.",
     "%1 is not used: its name is that of an estimate."},
    {"map.unfit_name",
     "{} is named like a map and not used: it has {}, but maps of one view or of all {}×{} views "
     "with {}×{} px are expected.",
     "%1 is not used: it has %2."},
    {"map.no_view",
     "{} of {} files {} belong to no view by their numbers, such as {}: they are not used.",
     "%1 of %2 files %3 match no view."},
    {"map.poor",
     "the map explains little of the ground truth: MSE×100 {:.3g} against {:.3g} of the best "
     "constant "
     "map; check its scale, units and view"},
    {"map.of_other_view",
     "the map fits the ground truth of view {} far better than that of view {}: MSE×100 {:.3g} "
     "instead of {:.3g}; name the view that it is of"},
    {"map.offset",
     "the map is off by {:+.3g} px everywhere: without that, MSE×100 would be {:.3g} instead of "
     "{:.3g}; check which focus plane it belongs to (--focus)"},
    {"map.nearer_to_truth", "the map fits the ground truth far better with {} ({})"},
    {"map.nearer_to_truth_alone",
     "the map fits the ground truth far better with {} ({}), but the views fit it as it is"},
    {"map.nearer_to_views", "the map explains the views far better with {} ({})"},
    {"map.views_exchanged",
     "The views of these maps seem to be stored in another order, {}: against the ground truth, "
     "MSE×100 "
     "is {:.3g} so and {:.3g} as read. Put the first two axes of the array in order.",
     "The maps seem to be of other views: %1."},
    {"map.masked", "{} leaves out {:.1f} % of the ground truth.",
     "%1 leaves out %2 % of the ground truth."},
    {"map.row_by_row", "The {} maps of {} are taken for those of the views, row by row.",
     "The maps of %2 are taken row by row."},
    {"map.border",
     "A border of {} px has one value only and counts as padding; {}×{} px are used."},
    {"map.middle",
     "The maps of {}×{} px are taken for the middle of {}×{} px, and judged there alone."},
    {"map.padded", "The maps of {}×{} px are padded {} with a constant; {}×{} px are used."},
    {"units.doubt",
     "No known unit explains the views well with {}: taken for {}, the next views differ by {:.2f} "
     "grey levels, with its values times {:.4g} by {:.2f}; if they are of another unit, convert "
     "the map to .pfm with --map-scale {:.4g}.",
     "The unit of %1 is in doubt."},
    {"units.offset",
     "No known unit explains the views well with {}: taken for {}, the next views differ by {:.2f} "
     "grey levels, with its values times {:.4g} plus {:.3g} px by {:.2f}. If the map was "
     "normalized or shifted, save it again in px: no option undoes that.",
     "%1 is normalized or lacks a constant."},
    {"units.warp", "mean grey error of neighboring views after warping {}, unwarped {}"},
    {"units.warp_stored",
     "mean grey error of neighboring views after warping {}, unwarped {}, with the values as "
     "stored "
     "{}"},
    {"units.fit", "{:.1f} % of the depth map agree within 0.01 px with d = {:.6g}/Z {} {:.6g}"},
    {"units.stored", "d = dH·focalLength/Z − shift with {}: {} … {} px for depth {} … {}"},
    {"units.as_stored", "dH and shift as stored"},
    {"units.width", "dH and shift times xRes"},
    {"units.width_of_dh", "dH times xRes, shift as stored"},
    {"units.camera", "the camera follows from disparity and depth"},
    // Files.
    {"dataset.left_out", "{} {}: left out."},
    {"dataset.elsewhere", "is a link to another file, which is not followed"},
    {"dataset.nothing", "is a link to nothing"},
    {"dataset.samples_elsewhere", "has its samples in other files, which are not read"},
    {"dataset.empty", "is empty"},
    {"dataset.records", "holds records of several fields (compound)"},
    {"dataset.no_numbers", "holds no numbers"},
    {"dataset.array", "array of {}"},
    {"dataset.null", "empty dataset"},
    {"companion.ignored", "The file of {} is ignored: {}.", "The file of %1 is ignored."},
    {"attribute.unlike",
     "The attribute {} says {}, but LF has {} along that axis; the shape of LF is used.",
     "The attribute %1 does not fit."},
    {"config.sign",
     "disp_min and disp_max of {} have the other sign than the ground truth, in which larger "
     "values are "
     "nearer; they were negated.",
     "disp_min and disp_max were negated."},
    {"config.range",
     "{} promises disparities of {:.2f} … {:.2f} px, but the ground truth has {:.2f} … {:.2f} px; "
     "methods "
     "search what is promised unless the range is found or given.",
     "%2 … %3 px are promised, the ground truth has %4 … %5 px."},
    {"config.no_range", "disp_min {:g} is not below disp_max {:g} in {}; neither is used.",
     "disp_min is not below disp_max."},
    {"config.no_number", "{}: {}, which is not a number; it is not used."},
    {"config.size", "{} of {} is {}, but the views have {} px; the size of the views is used.",
     "The image size of %2 is not used."},
    {"config.grid",
     "{} promises {}×{} views, but the files are {}×{}; correct num_cams_x and num_cams_y.",
     "%2×%3 views are promised, %4×%5 are there."},
    {"config.camera", "The camera of {} is ignored: {}.", "The camera is ignored."},
    {"config.missing", "{} is missing; add it"},
    {"frames.gap", "The frame number {} is missing; frames are counted without it.",
     "Frame %1 is missing."},
    {"conventions.unused", "The conventions that you set for this file were not used: {}",
     "Your conventions were not used."},
    {"labels.order",
     "The views were read in another order than they are stored ({}); the labels are taken in the "
     "order in which the views are shown. --flip none reads the views as they are stored.",
     "The labels are taken in the order in which the views are shown."},
    {"labels.no_view",
     "{} names none of the {}×{} views; its labels are taken for the center view ({}).",
     "%1 names none of the views; it is taken for the center view."},
    {"labels.numbers",
     "{} is taken for view ({}), but its name may mean view ({}) as well; keep only the numbers of "
     "row and column in it, as in 03_04.png.",
     "%1 is taken for view (%2)."},
    {"labels.foreign",
     "{} holds labels of pictures that are no views of this light field; they are left out: {}.",
     "Labels of other pictures in %1 are left out."},
    {"labels.renumbered", "Ids that other labels have, or above {}, became others: {}.",
     "Some labels have other ids than in the file."},
    {"labels.told_apart", "Labels of one name or color are told apart in these files: {}.",
     "Labels of one name or color were told apart."},
    {"labels.zero",
     "{}: 0 means unlabeled whatever is ignored ({:.4g} % of the pixels); --first-label 0 makes it "
     "a "
     "label, and raises all ids by one.",
     "0 means unlabeled."},
    {"labels.shapes",
     "No pixel belongs to {} in {}: the shapes are too small, outside of the picture, or covered.",
     "No pixel belongs to %1."},
    {"labels.unknown_shapes", "Shapes of the type {} in {} cannot be read: they are left out.",
     "Shapes of the type %1 are left out."},
    {"labels.raised_files",
     "Labels start at 0 in these files: all labels are raised by one, so that 0 means none.",
     "Labels are raised by one."},
    {"labels.raised_coco",
     "There is a category 0 in this file: all labels are raised by one, so that 0 means none.",
     "Labels are raised by one."},
    {"labels.exchanged",
     "{} holds labels of {}×{} px for views of {}×{} px: rows and columns were exchanged.",
     "The labels of %1 were turned."},
    {"labels.smoothed",
     "{} of the {} labels lie only between others, as on smoothed (antialiased) edges: draw "
     "with a hard brush, or list the colors that count in a table.",
     "%1 of the %2 labels may be smoothed edges."},
    {"labels.raised",
     "Labels start at 0 in this file and unpainted pixels are marked by another value: all labels "
     "are raised by one, so that 0 means unpainted.",
     "Labels are raised by one."},
    {"views.no_config",
     "There is no parameters.cfg: the grid of {}×{} views was inferred from the number of files.",
     "The grid of %1×%2 views was inferred."},
    {"views.part",
     "Of a grid of {}×{} {} (row,column {}): the largest part without a gap is opened, {}×{} "
     "views, "
     "{} and {}; {} other views are not used.",
     "Using %5×%6 of %1×%2 views; others are missing."},
    {"views.part_but_one",
     "Of a grid of {}×{} {} (row,column {}): the largest part without a gap is opened, {}×{} "
     "views, "
     "{} and {}; {} other view is not used.",
     "Using %5×%6 of %1×%2 views; others are missing."},
    {"views.subsampled",
     "The names number {} {}: the grid is subsampled, and disparities are per {} steps of the "
     "numbers.",
     "The grid is subsampled: every %3th view"},
    {"views.arranged", "The views are not {}×{}, row by row, but {}: {}.", "The views are %3."},
    {"views.axes_unclear",
     "The views differ too little to tell rows from columns of views; if they are exchanged, state "
     "the axes as {}.",
     "Rows and columns may be exchanged."},
    {"views.uneven", "The names number {} {}: they are taken for neighbors at equal distances.",
     "Views are numbered with gaps."},
    {"views.begin", "Rows begin at {} and columns at {}: perhaps a {} of views is missing.",
     "Perhaps a %3 of views is missing."},
    {"views.other_folders", "The views are those of {}; pictures in {} are left out.",
     "Pictures in %2 are left out."},
    {"views.other_names",
     "{} images look like views, but their names have another form, such as {}: they are not used. "
     "If they belong to the grid, name a pattern that matches all.",
     "%1 images with other names are not used."},
    {"views.channels", "Of {} channels of a view the first three are read, as red, green and blue.",
     "Only three of %1 channels are read."},
    {"views.remainder",
     "The picture has {}×{} px, which {} does not divide: the last {} columns and {} rows of "
     "pixels "
     "are left out.",
     "The last %4 columns and %5 rows of pixels are left out."},
    {"views.poses_unused",
     "The poses of {} are not used, as {}; the names and the views themselves tell rows and "
     "columns.",
     "The poses of %1 are not used."},
    // Raw pictures of plenoptic cameras.
    {"plenoptic.white", "white picture {}", "White picture %1", FindingLevel::Note},
    {"plenoptic.white_inside",
     "white picture: the one in the file of the raw picture",
     {},
     FindingLevel::Note},
    {"plenoptic.white_nearest",
     "white picture {} ({}) is the nearest of {} to the raw picture ({})", "White picture %1",
     FindingLevel::Note},
    {"plenoptic.white_exposed",
     "white picture {} ({}) is the nearest of {} to the raw picture ({}), and better exposed than "
     "{}",
     "White picture %1", FindingLevel::Note},
    {"plenoptic.white_steps", "white picture {} ({}); the raw picture has {}", "White picture %1",
     FindingLevel::Note},
    {"plenoptic.decoded",
     "decoded from {}: {} lenses of {:.2f} px, turned by {:.3f}°, views {:.3g} px apart", "",
     FindingLevel::Note},
    {"plenoptic.dark", "dark picture {}", "Dark picture %1", FindingLevel::Note},
    {"plenoptic.no_white",
     "without a white picture the lenses were found in the raw picture itself, and their "
     "vignetting "
     "remains; give one with --white",
     "No white picture: vignetting remains"},
    {"plenoptic.white_off",
     "The raw picture shows its lenses {:.2f} px from those of the white picture: it is of another "
     "camera or zoom, or the raw picture is too dark to tell.",
     "The white picture's lenses are %1 px off."},
    {"plenoptic.white_saturated",
     "{:.1f} % of the white picture is saturated: what the lenses shade is not known there. Expose "
     "it shorter.",
     "%1 % of the white picture is saturated."},
    {"plenoptic.white_dark",
     "The white picture has only {:.1f} % of the light that the sensor can take, so its noise "
     "remains in the views. Expose it longer.",
     "The white picture is dark: %1 % of the range."},
    {"plenoptic.neutral",
     "colors were made neutral by the white picture: red times {:.2f}, blue times {:.2f}",
     {},
     FindingLevel::Note},
    {"plenoptic.bits", "samples of {} bits, according to the largest one", {}, FindingLevel::Note},
    {"plenoptic.pitch",
     "The lenses were found {:.2f} px apart, but according to its pitches of lenses and pixels the "
     "camera has them {:.2f} px apart: check the white picture and the optics.",
     "Lenses are %1 px apart, not %2 px as the camera says."},
    {"plenoptic.processed",
     "This container of a Lytro camera holds processed pictures, without what the sensor saw: {}. "
     "They are no views of a light field; episcope-cli decode writes them as files.",
     "Processed pictures, no light field: %1", FindingLevel::Note},
    {"labels.colors_first", "A first label of 0 has no effect on colors, which are no numbers."},
    {"option.ignored", "--{} is ignored, because this is {}.", "“%1” is ignored."},
    {"scribbles.unread", "Scribbles were not read: {}"},
    {"render.part",
     "{} of {} views are rendered so far; shown are the {}×{} around the center. Read it again to "
     "see more; if the rendering was stopped, the same command in Blender continues it.",
     "Using %3×%4 views; %1 of %2 are rendered so far."},
    {"views.cross",
     "The views form a cross of row {} and column {} ({}): those of the {}, {}×{}, are opened, the "
     "{} others are not used; a pattern with the number of the {} instead of {} opens these.",
     "Using the views of the %4 of a cross."},
    {"row", "row"},
    {"column", "column"},
    {"numbers.row", "row {}"},
    {"numbers.rows", "rows {}"},
    {"numbers.column", "column {}"},
    {"numbers.columns", "columns {}"},
    {"numbers.missing", "view {} is missing"},
    {"numbers.all_missing", "{} views are missing: {}"},
    // Results.
    {"result.confidence", "confidence is left out: it has values beyond 0 … 1"},
    {"result.high_resolution", "scores in high resolution are left out: {}"},
    {"brightness.fall_off", "brightness of the views evened: fall-off {:.3f}"},
    // Forms of light fields, and what their files are.
    {"format.grid", "image grid ({})"},
    {"format.posed", "*, placed by {}"},
    {"format.archive", "archive ({})"},
    {"format.quilt", "quilt of {} tiles, a line of views from the bottom left ({})"},
    {"format.mosaic_up", "mosaic of {} views side by side, rows from the bottom ({})"},
    {"format.lenslets", "mosaic of lenslets of {} px ({})"},
    {"format.mosaic", "mosaic of {} views side by side ({})"},
});

/// The English of a code, for fmt. An unknown code is an error of the compiler.
consteval std::string_view finding_text(std::string_view code) {
  const auto* found = std::ranges::find(kFindingTexts, code, &FindingText::code);
  return found->english;
}

/// The finding that a sentence tells, the most special one; none for a sentence of another kind.
[[nodiscard]] std::optional<Finding> finding_of(std::string_view sentence);

/// Whether the sentence tells a note; any other is a warning.
[[nodiscard]] bool is_note(std::string_view sentence);

/// The entry of a code among `kFindingTexts`; null for an unknown one.
[[nodiscard]] const FindingText* find_finding_text(std::string_view code);

/// An English text with its placeholders as translations have them: "%1", "%2", ….
[[nodiscard]] std::string numbered(std::string_view english);

}  // namespace episcope
