(** * Positive weights are definite, weights that are not zero are nondegenerate

    For stages at points. Positive means: in an ordering of ℚ(θ), as each real root θ gives one. *)

From Coq Require Import QArith List Arith Lia.
From Gark Require Import Stages Methods Sums Check Pairs Products Conditions.
Import ListNotations.
Open Scope Q_scope.

(** b_{l,i}, by its coefficients. *)
Definition weight M l i : V := fun e => nth e (nth i (snd (nth l (colours M) (O, []))) []) 0.
Definition stages M l := size_of (space_at M l).
Definition at_points M := every_colour M (fun l => exists s, space_at M l = Points s).
(** x = y as numbers of ℚ(θ). *)
Definition equal M (x y : V) := forall e, (e < degree M)%nat -> x e == y e.

(** The positive numbers of an ordering of ℚ(θ). *)
Record ordering M (positive : V -> Prop) : Prop := {
  o_ext : forall x y, equal M x y -> positive x -> positive y;
  o_add : forall x y, positive x -> positive y -> positive (add x y);
  o_times : forall x y, positive x -> positive y -> positive (times M x y);
  o_square : forall x, ~ equal M x (fun _ => 0) -> positive (times M x x);
  o_zero : ~ positive (fun _ => 0) }.

Definition positive_weights M (positive : V -> Prop) :=
  every_colour M (fun l => forall i, (i < stages M l)%nat -> positive (weight M l i)).

Lemma zero_or_not M x : equal M x (fun _ => 0) \/ ~ equal M x (fun _ => 0).
Proof.
  destruct (all (degree M) (fun e => Qeq_bool (x e) 0)) eqn:Z.
  - left. intros e He. apply Qeq_bool_iff, (all_at _ _ Z e He).
  - right. intros E. apply Bool.not_true_iff_false in Z. apply Z, forallb_forall. intros e He.
    apply in_seq in He. apply Qeq_bool_iff, E. lia.
Qed.

Section Points.
Variable M : method.
Hypothesis points : at_points M.

(** b_l(v) is the sum of b_{l,i} v_i. *)
Lemma b_at l e v : b M l e v ==
  sum (seq 0 (length (snd (nth l (colours M) (O, [])))))
    (fun i => times M (weight M l i) (number_at M v i) e).
Proof. apply row_is. Qed.

Lemma number_beyond l x y i e : (l < N M)%nat -> (stages M l <= i)%nat ->
  number_at M (mul (Pof M l) x y) i e == 0.
Proof. intros Hl Hi. apply mu_beyond. unfold dim, entry, stages in *. cbn [fst snd]. nia. Qed.
Lemma product_at l x y i : (l < N M)%nat -> (i < stages M l)%nat ->
  equal M (number_at M (mul (Pof M l) x y) i) (times M (number_at M x i) (number_at M y i)).
Proof.
  intros Hl Hi e He. destruct (points l Hl) as [s Hs]. unfold stages in Hi. rewrite Hs in Hi.
  exact (mu_at_points M l s x y i e Hs Hi He).
Qed.
Lemma weight_beyond l i : (length (snd (nth l (colours M) (O, []))) <= i)%nat ->
  equal M (weight M l i) (fun _ => 0).
Proof. intros H e _. unfold weight. rewrite (nth_overflow _ _ H). destruct e; reflexivity. Qed.

(** A sum of terms that are positive or zero is zero only if all of them are. *)
Lemma sum_of_positive positive (t : nat -> V) js : ordering M positive ->
  (forall j, In j js -> positive (t j) \/ equal M (t j) (fun _ => 0)) ->
  (forall j, In j js -> equal M (t j) (fun _ => 0)) \/ positive (fun e => sum js (fun j => t j e)).
Proof.
  intros Ord. induction js as [|j js IH]; intros H; [left; contradiction|].
  destruct (H j (or_introl eq_refl)) as [P|Z];
    destruct IH as [Zs|Ps]; try (intros; apply H; right; assumption).
  - right. apply (o_ext _ _ Ord (t j)); [|exact P]. intros e He.
    change (t j e == t j e + sum js (fun j => t j e)).
    rewrite sum_zero; [ring|]. intros i Hi. exact (Zs i Hi e He).
  - right. exact (o_add _ _ Ord _ _ P Ps).
  - left. intros i [<-|Hi]; [exact Z|apply Zs, Hi].
  - right. apply (o_ext _ _ Ord _ _ (fun e He => Qeq_sym _ _ (Qeq_trans _ _ _
      (Qplus_comp _ _ (Z e He) _ _ (Qeq_refl _)) (Qplus_0_l _))) Ps).
Qed.

Theorem positive_is_definite positive : ordering M positive -> positive_weights M positive ->
  definite M.
Proof.
  intros Ord P l Hl v H n Hn. destruct (entry_of M n _ Hn) as [i [e [Hi [He ->]]]].
  destruct (zero_or_not M (number_at M v i)) as [Z|Z]; [exact (Z e He)|exfalso].
  set (t := fun j => times M (weight M l j) (number_at M (mul (Pof M l) v v) j)).
  set (js := seq 0 (length (snd (nth l (colours M) (O, []))))).
  assert (Pos : forall j, (j < stages M l)%nat -> ~ equal M (number_at M v j) (fun _ => 0) ->
    positive (t j)).
  { intros j Hj Nz. apply (o_ext _ _ Ord (times M (weight M l j)
      (times M (number_at M v j) (number_at M v j)))).
    - intros f Hf. apply times_ext; [reflexivity|]. intros u Hu. symmetry.
      apply product_at; assumption.
    - apply (o_times _ _ Ord); [apply P; assumption|apply (o_square _ _ Ord), Nz]. }
  destruct (sum_of_positive positive t js Ord) as [Zs|Ps].
  - intros j _. destruct (le_lt_dec (stages M l) j) as [L|L].
    + right. intros f Hf. apply (times_zero M). right. intros u _. apply number_beyond; assumption.
    + destruct (zero_or_not M (number_at M v j)) as [Zj|Zj]; [right|left; apply Pos; assumption].
      intros f Hf. apply (times_zero M). right. intros u Hu. rewrite (product_at l v v j Hl L u Hu).
      apply (times_zero M). left. exact Zj.
  - apply (o_zero _ _ Ord), (o_ext _ _ Ord (t i)); [|apply Pos; assumption]. apply Zs, in_seq.
    destruct (le_lt_dec (length (snd (nth l (colours M) (O, [])))) i) as [L|L]; [exfalso|lia].
    apply (o_zero _ _ Ord), (o_ext _ _ Ord (weight M l i)); [apply weight_beyond, L|].
    apply P; assumption.
  - apply (o_zero _ _ Ord). revert Ps. apply (o_ext _ _ Ord). intros f Hf.
    change (sum js (fun j => t j f) == 0). unfold t, js. rewrite <- b_at, (H f Hf). unfold rational.
    destruct (Nat.eqb f 0); reflexivity.
Qed.
End Points.

(** ** Over ℚ *)

Section Rationals.
Variable M : method.
Hypothesis points : at_points M.
Hypothesis rational_M : degree M = 1%nat.

Lemma times_rational x y : times M x y 0 == x 0%nat * y 0%nat.
Proof.
  rewrite times_is, rational_M. unfold sum. simpl.
  rewrite rational_times by (rewrite rational_M; lia). simpl. ring.
Qed.
Lemma equal_rational x y : equal M x y <-> x 0%nat == y 0%nat.
Proof.
  unfold equal. rewrite rational_M. split; [intros H; apply H; lia|].
  intros H e He. replace e with 0%nat by lia. exact H.
Qed.

Lemma usual_ordering : ordering M (fun x => 0 < x 0%nat).
Proof.
  split; cbv beta.
  - intros x y E P. apply (proj1 (equal_rational _ _)) in E. rewrite <- E. exact P.
  - intros x y P R. apply (Qplus_lt_le_compat 0 _ 0 _); [exact P|apply Qlt_le_weak, R].
  - intros x y P R. rewrite times_rational. apply Qmult_lt_0_compat; assumption.
  - intros x Z. rewrite equal_rational in Z. rewrite times_rational.
    destruct (Qlt_le_dec 0 (x 0%nat * x 0%nat)) as [L|L]; [exact L|exfalso]. apply Z.
    unfold Qle, Qeq in *. simpl in *. nia.
  - apply Qlt_irrefl.
Qed.

Definition nonzero_weights :=
  every_colour M (fun l => forall i, (i < stages M l)%nat -> ~ weight M l i 0%nat == 0).

Theorem nonzero_is_nondegenerate : nonzero_weights -> nondegenerate M.
Proof.
  intros P l Hl v H n Hn. destruct (entry_of M n _ Hn) as [i [e [Hi [He ->]]]].
  change (i < stages M l)%nat in Hi.
  rewrite rational_M in He. replace e with 0%nat in * by lia. pose proof (P l Hl i Hi) as Nz.
  specialize (H (unit (entry M (i, 0%nat))) 0%nat ltac:(lia)). rewrite b_at in H.
  assert (Li : (i < length (snd (nth l (colours M) (O, []))))%nat).
  { apply Nat.nle_gt. intros K. apply Nz, (weight_beyond M l i K). rewrite rational_M. auto. }
  rewrite (sum_ext _ _ (fun j => (if Nat.eqb j i then 1 else 0)
    * (weight M l i 0%nat * v (entry M (i, 0%nat))))) in H.
  - rewrite sum_at in H by exact Li. apply Qmult_integral in H.
    destruct H as [H|H]; [contradiction|exact H].
  - intros j _. rewrite times_rational. destruct (le_lt_dec (stages M l) j) as [L|L].
    + rewrite number_beyond by assumption. destruct (Nat.eqb_spec j i); [lia|ring].
    + rewrite (product_at M points l (unit (entry M (i, 0%nat))) v j Hl L 0%nat) by lia.
      rewrite times_rational. unfold number_at.
      rewrite unit_at, entry_eq by lia. destruct (Nat.eqb_spec j i) as [->|]; simpl; ring.
Qed.
End Rationals.
