// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/annotate/labeling_source.h"

#include "engine/core/error.h"

namespace episcope {

LabelingSource::LabelingSource(Session& session, Jobs& jobs, QObject* parent)
    : QObject(parent), session_(session), jobs_(jobs) {
  session_.on_changed([this](Parts parts) { update(parts); });
}

void LabelingSource::update(Parts parts) {
  if (parts.has(Part::Scene)) choice_ = Automatic;
  if (parts.has_any(Part::Scene | Part::Scenes)) leaveGone();
  if (!parts.has_any(Part::Scene | Part::Estimates | Part::Shown)) return;
  if (choice_ > 0 && !session_.find_estimate(choice_)) choice_ = Automatic;
  emit changed();
}

// Disparities of closed scenes take as much memory as a result.
void LabelingSource::leaveGone() {
  std::erase_if(own_, [this](const auto& own) {
    const OpenScene* scene = session_.find_scene(own.first);
    return !scene || !scene->scene;
  });
}

void LabelingSource::choose(int choice) {
  choice_ = choice;
  emit changed();
}

bool LabelingSource::coversAll(const DisparityField& field) const {
  return !field.empty() && field.disparity.grid() == session_.light_field()->grid();
}

LabelingDisparity LabelingSource::fieldOf(const EstimateEntry* entry) const {
  if (!entry || !coversAll(entry->estimate->field)) return {};
  return disparity_of(entry->estimate, entry->name);
}

LabelingDisparity LabelingSource::truth() const {
  const GroundTruthPtr& truth = session_.scene()->truth;
  if (!coversAll(truth->field)) return {};
  return {{truth, &truth->field}, "truth", nullptr};
}

LabelingDisparity LabelingSource::automatic() const {
  if (LabelingDisparity shown = fieldOf(session_.shown()); shown.field) return shown;
  const auto& entries = session_.estimates();
  for (auto entry = entries.rbegin(); entry != entries.rend(); ++entry) {
    if (LabelingDisparity found = fieldOf(&*entry); found.field) return found;
  }
  const auto own = own_.find(session_.generation());
  return own == own_.end() ? LabelingDisparity{} : own->second;
}

LabelingDisparity LabelingSource::find(FeatureSet features) const {
  if (!session_.scene()) return {};
  if (features == FeatureSet::ImageTruth || choice_ == Truth) return truth();
  if (choice_ == None) return {};
  return choice_ == Automatic ? automatic() : fieldOf(session_.find_estimate(choice_));
}

std::vector<SegmentPanel::Source> LabelingSource::sources() const {
  std::vector<SegmentPanel::Source> sources{{Automatic, tr("automatic"), true},
                                            {None, tr("none, images only"), true}};
  if (!session_.scene()) return sources;
  sources.push_back({Truth, tr("the ground truth"), truth().field != nullptr});
  for (const EstimateEntry& entry : session_.estimates()) {
    sources.push_back(
        {entry.id, QString::fromStdString(entry.name), fieldOf(&entry).field != nullptr});
  }
  return sources;
}

bool LabelingSource::isComing() const {
  return choice_ == Automatic && jobs_.count(Lane::Estimate) > 0 && !automatic().field;
}

void LabelingSource::provide() {
  const std::shared_ptr<const Scene> scene = session_.scene();
  const std::uint64_t generation = session_.generation();
  if (!scene || choice_ != Automatic || automatic().field || own_.contains(generation) ||
      jobs_.count(Lane::Estimate) > 0) {
    return;
  }
  own_[generation] = {};
  job_ = jobs_.start<EstimatePtr>(
      Lane::Estimate, job_title(tr("Disparity for labels"), session_),
      [scene](const Progress& progress) {
        return estimate_for_labels(*scene, Device::Auto, progress);
      },
      [this, generation](const EstimatePtr& estimate) {
        const auto own = own_.find(generation);
        if (own == own_.end()) return;
        own->second = disparity_of(estimate, kLabelingEstimator);
        session_.set_label_disparity(generation, own->second.field);
      },
      [this] { emit changed(); });
  jobs_.setScene(job_, generation);
  jobs_.setExpendable(job_);  // the program began it
}

EdgeSource::EdgeSource(Session& session, QObject* parent)
    : QObject(parent), session_(session), read_job_(this) {
  session_.on_changed([this](Parts parts) {
    if (parts.has(Part::Scene)) read();
  });
}

std::shared_ptr<const ViewStack<float>> EdgeSource::edges() const {
  return generation_ == session_.generation() ? edges_ : nullptr;
}

QString EdgeSource::origin() const {
  return edges() ? tr("Boundaries follow the edge weights of the file beside the light field.")
                 : tr("Boundaries follow edges computed from the image and, where it is known, the "
                      "disparity.");
}

void EdgeSource::read() {
  edges_ = nullptr;
  generation_ = session_.generation();
  read_job_.drop();
  const auto& scene = session_.scene();
  if (!scene || !has_edge_probabilities(*scene)) return;
  read_job_.start<Read>(
      [scene](const Progress& progress) -> Read {
        try {
          return {find_edge_probabilities(*scene, progress), {}};
        } catch (const IoError& error) {
          return {nullptr, error.what()};
        }
      },
      [this](const Read& read) { take(read); });
}

void EdgeSource::take(const Read& read) {
  edges_ = read.edges;
  if (edges_) {
    emit changed();
  } else {
    emit failed(tr("%1. Edges are computed instead.").arg(QString::fromStdString(read.failure)));
  }
}

}  // namespace episcope

#include "moc_labeling_source.cpp"
