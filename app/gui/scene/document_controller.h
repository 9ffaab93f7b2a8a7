// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "annotation/brush.h"
#include "app/gui/shell/jobs.h"
#include "app/session/annotation_journal.h"
#include "app/session/session.h"

#include <QObject>
#include <QString>

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace episcope {

/// A document of an open scene that has a journal.
struct EditedDocument {
  std::uint64_t scene = 0;  ///< OpenScene::id.
  std::filesystem::path journal;
  std::uint64_t state = 0;         ///< AnnotationDocument::state.
  std::filesystem::path stored{};  ///< The file of a project that holds it now.
};

/// The annotation documents of the open light fields, of which one is shown: creates it, changes
/// it, keeps its journal and reports changes. Whatever shows, saves or learns from scribbles
/// listens to this.
class DocumentController : public QObject {
  Q_OBJECT

 public:
  explicit DocumentController(Session& session, QObject* parent);
  ~DocumentController() override;

  /// Where journals are kept, the user's own folder at first; empty = nowhere.
  void setJournalFolder(std::filesystem::path folder);
  [[nodiscard]] const std::filesystem::path& journalFolder() const { return journal_folder_; }

  /// Null if nothing is open, or not yet.
  [[nodiscard]] AnnotationDocument* document();
  [[nodiscard]] const AnnotationDocument* document() const;
  /// Whether it holds all scribbles of the light field's own files; if not, those must not be
  /// overwritten.
  [[nodiscard]] bool isWhole() const { return now_.is_whole; }
  [[nodiscard]] bool hasUnsavedChanges() const;
  /// Whether its last changes are in a project only, not in the file of scribbles.
  [[nodiscard]] bool isInProjectOnly() const;
  /// The file that it was saved to last; empty if it was not.
  [[nodiscard]] std::string file() const;
  /// Puts another document in the place of the present one, whose journal ends. `is_whole` and
  /// `file` as above.
  /// Returns whether it is kept in a journal.
  bool replace(AnnotationDocument document, bool is_whole, const std::string& file);
  /// Notes that the state of a scene's document was written to a file; if painting went on
  /// meanwhile, there are unsaved changes still.
  void noteSaved(std::uint64_t scene, std::uint64_t state, const std::string& file);
  /// The user discards the present changes: they may be dropped with the document.
  void discardChanges();
  /// The same of all open scenes.
  void discardAll();
  /// Open scenes (OpenScene::id) whose documents have changes that no file holds.
  [[nodiscard]] std::vector<std::uint64_t> unsavedScenes() const;
  /// The documents of open scenes that were edited, each with its journal and its state now.
  [[nodiscard]] std::vector<EditedDocument> editedDocuments() const;
  /// Notes that these states are in a project.
  void noteKept(const std::vector<EditedDocument>& documents);
  /// What was painted before on a scene that is set aside. `stored`: the file of a project of the
  /// user's that holds it; empty = none does. Returns whether it is kept in a journal anew.
  bool bring(std::uint64_t scene, RecoveredAnnotation found, std::filesystem::path stored);
  /// Ensures that what is painted next survives a crash; whether that is so.
  bool keepJournal();

  /// Applies any edit; what it throws is reported as a problem. Returns whether the document
  /// changed.
  bool edit(const std::function<void(AnnotationDocument&)>& change);
  void undo();
  void redo();

  /// A stroke on one view, under way until it is ended or cancelled. False if it cannot begin.
  bool beginStroke(ViewIndex view, const PaintStyle& style, StrokePoint at);
  void extendStroke(StrokePoint at);
  void endStroke();
  void cancelStroke();
  [[nodiscard]] bool isStroking() const { return stroke_ != nullptr; }

 signals:
  /// Another document, or none.
  void replaced();
  /// Pixels of a view changed within a stroke.
  void painted(episcope::ViewIndex view, const episcope::PixelRect& rect);
  /// The history went a step forward or back. Rectangles may cover more than what changed.
  void changed(const episcope::DocumentChange& change);
  /// As `changed`, by undo or redo, with the edit undone or redone: who works on it wants to see
  /// where.
  void steppedBack(const episcope::DocumentChange& change, const episcope::Edit& edit,
                   bool is_undo);
  void unsavedChanged(bool has_unsaved_changes);
  /// A sentence for the user.
  void problem(const QString& sentence);

 private:
  /// A document that is open.
  struct Open {
    std::unique_ptr<Annotation> annotation;
    bool is_whole = true;
    std::filesystem::path stored{};  ///< The file of a project that held it last.
    std::optional<std::uint64_t> discarded_state{};
    std::optional<std::uint64_t> project_state{};  ///< What a project holds and no other file.
    void note_kept(const EditedDocument& kept);
    [[nodiscard]] bool has_unsaved_changes() const;
  };

  void update(Parts parts);
  void openDocument();
  void leaveDocument();
  void leaveClosed();
  /// Takes the document that was set aside for the scene that is shown; false if there is none.
  bool takeAside();
  void beginHash();
  /// Ends a document: a journal with unsaved changes stays, to be offered at the next start.
  static void finish(Open& open);
  void setDocument(AnnotationDocument document, bool is_whole, const std::string& file);
  void go(DocumentChange (AnnotationDocument::*step)());
  void markSaved(Open& open, std::uint64_t state);
  /// The document of a scene that is set aside; null if there is none.
  [[nodiscard]] Open* findAside(std::uint64_t scene);
  bool keepJournal(Open& open);
  void tell(const DocumentChange& change);
  void tellUnsaved();
  /// Runs a change and reports what it threw. A journal that fails is abandoned; what a project
  /// holds of the strokes then stays in it.
  void run(const std::function<void()>& change) { run(now_, change); }
  void run(Open& open, const std::function<void()>& change);
  [[nodiscard]] std::uint64_t sceneOf(const Open& open) const;
  [[nodiscard]] DocumentChange everything() const;
  [[nodiscard]] bool isCurrent() const;

  Session& session_;
  std::filesystem::path journal_folder_;
  Open now_;
  std::map<std::uint64_t, Open> aside_;  // by scene
  std::uint64_t generation_ = 0;         // of the scene that `now_` belongs to
  std::uint64_t sample_hash_ = 0;        // of the light field; 0 = not known yet
  LatestJob hash_job_;
  std::unique_ptr<Stroke> stroke_;
  ViewIndex stroke_view_;
  PixelRect stroke_rect_;
  std::optional<std::uint64_t> written_state_;  // noted while a stroke was under way
  bool was_unsaved_ = false;
};

/// The current label of the document: the one painted with and whose probability is shown.
class LabelChoice : public QObject {
  Q_OBJECT

 public:
  LabelChoice(DocumentController& document, QObject* parent);

  /// Id of the current label; 0 without labels.
  [[nodiscard]] int current() const { return current_; }
  /// The same with name and colour; null without labels.
  [[nodiscard]] const LabelInfo* info() const;
  /// Returns whether there is such a label.
  bool choose(int id);
  void chooseNext();
  /// Back to the label before this one.
  void swap();

 signals:
  /// The current label is another one, or has another name or colour.
  void changed();

 private:
  void followDocument();
  [[nodiscard]] bool isKnown(int id) const;

  DocumentController& document_;
  int current_ = 0;
  int former_ = 0;
};

}  // namespace episcope
