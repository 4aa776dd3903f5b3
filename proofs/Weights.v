(** * Positive weights are definite, weights that are not zero are nondegenerate

    Rational methods with stages at points. *)

From Coq Require Import QArith List Arith Lia.
From Gark Require Import Stages Methods Sums Check Pairs Products Conditions Definite.
Import ListNotations.
Open Scope Q_scope.

(** b_{l,i}, and its part of θ^0, which is all of it over the rationals. *)
Definition weight M l i : Q := nth 0 (nth i (snd (nth l (colours M) (O, []))) []) 0.
Definition rational_at_points M := degree M = 1%nat /\
  every_colour M (fun l => exists s, the_space M (space_of M l) = Points s).
Definition stages M l := size_of (the_space M (space_of M l)).

(** All b_{l,i} are positive, or none is zero. *)
Definition positive_weights M :=
  every_colour M (fun l => forall i, (i < stages M l)%nat -> 0 < weight M l i).
Definition nonzero_weights M :=
  every_colour M (fun l => forall i, (i < stages M l)%nat -> ~ weight M l i == 0).

Section Weights.
Variable M : method.
Hypothesis rational_M : rational_at_points M.

Lemma degree_is_1 : degree M = 1%nat.
Proof. apply rational_M. Qed.

Lemma dim_is_stages l : dim M l = stages M l.
Proof. unfold dim. rewrite degree_is_1. apply Nat.mul_1_r. Qed.

Lemma in_field_is_1 : in_field M 0 0 0 == 1.
Proof. rewrite rational_times by (rewrite degree_is_1; lia). reflexivity. Qed.

(** Products are componentwise. *)
Lemma product_at l x y i : (l < N M)%nat -> (i < stages M l)%nat ->
  mul (Pof M l) x y i == x i * y i.
Proof.
  intros Hl Hi. destruct rational_M as [_ H]. destruct (H l Hl) as [s Hs].
  assert (E : i = entry M (i, 0%nat)) by (unfold entry; rewrite degree_is_1; simpl; lia).
  rewrite E at 1. rewrite mu_at; [|exact Hi|rewrite degree_is_1; lia].
  unfold every. rewrite degree_is_1, sum_pairs, !sum_pairs. unfold stages in Hi. unfold space_at.
  rewrite Hs in *. simpl size_of in *.
  rewrite (sum_ext _ _ (fun a => (if Nat.eqb a i then 1 else 0) * (x i * y i))).
  - rewrite sum_at by exact Hi. reflexivity.
  - intros a _. unfold sum at 1. simpl. rewrite sum_pairs.
    rewrite (sum_ext _ _ (fun d => (if Nat.eqb d i then 1 else 0) * ((if Nat.eqb a i then 1 else 0)
      * (x i * y i)))).
    + rewrite sum_at by exact Hi. ring.
    + intros d _. unfold sum. simpl. rewrite (Nat.eqb_sym i a), (Nat.eqb_sym i d).
      rewrite in_field_is_1. unfold entry. rewrite degree_is_1. simpl.
      destruct (Nat.eqb_spec a i) as [->|]; destruct (Nat.eqb_spec d i) as [->|]; simpl; try ring.
      rewrite Nat.mul_1_r, Nat.add_0_r. ring.
Qed.

(** b_l(v) is the sum of b_{l,i} v_i. *)
Lemma b_at l v : b M l 0 v ==
  sum (seq 0 (length (snd (nth l (colours M) (O, []))))) (fun i => weight M l i * v i).
Proof.
  unfold b, weights, weight. rewrite row_is. apply sum_ext. intros i _.
  rewrite times_is, degree_is_1. unfold sum, number_at, entry. rewrite degree_is_1. simpl.
  rewrite in_field_is_1, Nat.mul_1_r, Nat.add_0_r. ring.
Qed.

Lemma quadrature_at l v : quadrature M l v 0 <-> b M l 0 v == 0.
Proof.
  unfold quadrature, rational. rewrite degree_is_1. split; intros H; [exact (H 0%nat ltac:(lia))|].
  intros e He. replace e with 0%nat by lia. exact H.
Qed.

Lemma enough_weights l i : ~ weight M l i == 0 ->
  (i < length (snd (nth l (colours M) (O, []))))%nat.
Proof.
  intros H. apply Nat.nle_gt. intros K. apply H. unfold weight. rewrite (nth_overflow _ _ K).
  reflexivity.
Qed.

Lemma sum_of_nonnegative n f : (forall i, (i < n)%nat -> 0 <= f i) ->
  0 <= sum (seq 0 n) f /\ (sum (seq 0 n) f == 0 -> forall i, (i < n)%nat -> f i == 0).
Proof.
  intros H. induction n; [split; [apply Qle_refl|intros _ i Hi; lia]|].
  destruct IHn as [Pos Zero]; [intros; apply H; lia|]. pose proof (H n ltac:(lia)) as Hn.
  rewrite seq_S, sum_app, sum_one. split; [apply (Qplus_le_compat 0 _ 0 _); assumption|].
  intros E. destruct (sum_is_0 _ _ Pos Hn E) as [Z Last]. intros i Hi.
  destruct (Nat.eq_dec i n) as [->|]; [exact Last|apply Zero; [exact Z|lia]].
Qed.

Theorem positive_is_definite : positive_weights M -> definite M.
Proof.
  intros P l Hl v H i Hi. apply (proj1 (quadrature_at _ _)) in H. rewrite b_at in H.
  rewrite dim_is_stages in Hi.
  assert (At : forall j, weight M l j * mul (Pof M l) v v j ==
      if Nat.ltb j (stages M l) then weight M l j * (v j * v j) else 0).
  { intros j. destruct (Nat.ltb_spec j (stages M l)) as [L|L]; [rewrite product_at by assumption;
    reflexivity|].
    rewrite mu_beyond by (rewrite dim_is_stages; exact L). ring. }
  rewrite (sum_ext _ _ (fun j => if Nat.ltb j (stages M l) then weight M l j * (v j * v j) else 0))
    in H
    by (intros; apply At).
  pose proof (P l Hl i Hi) as Pi.
  assert (Nz : ~ weight M l i == 0) by (intros Z; rewrite Z in Pi; exact (Qlt_irrefl 0 Pi)).
  assert (T : weight M l i * (v i * v i) == 0).
  { assert (Non : forall j, (j < length (snd (nth l (colours M) (O, []))))%nat ->
        0 <= if Nat.ltb j (stages M l) then weight M l j * (v j * v j) else 0).
    { intros j _. destruct (Nat.ltb_spec j (stages M l)) as [L|L]; [|apply Qle_refl].
      apply Qmult_le_0_compat; [apply Qlt_le_weak, P; assumption|apply square_nonnegative]. }
    pose proof (proj2 (sum_of_nonnegative _ _ Non) H i (enough_weights l i Nz)) as K. simpl in K.
    apply Nat.ltb_lt in Hi. rewrite Hi in K. exact K. }
  apply Qmult_integral in T. destruct T as [T|T]; [contradiction|].
  apply Qmult_integral in T. destruct T; assumption.
Qed.

Theorem nonzero_is_nondegenerate : nonzero_weights M -> nondegenerate M.
Proof.
  intros P l Hl v H i Hi. specialize (H (unit i)). apply (proj1 (quadrature_at _ _)) in H.
  rewrite b_at in H.
  rewrite dim_is_stages in Hi. pose proof (P l Hl i Hi) as Nz.
  rewrite (sum_ext _ _ (fun j => (if Nat.eqb j i then 1 else 0) * (weight M l i * v i))) in H.
  - rewrite (sum_at _ i (fun _ => weight M l i * v i) (enough_weights l i Nz)) in H.
    apply Qmult_integral in H. destruct H as [H|H]; [contradiction|exact H].
  - intros j _. destruct (le_lt_dec (stages M l) j) as [L|L].
    + rewrite mu_beyond by (rewrite dim_is_stages; exact L).
      destruct (Nat.eqb_spec j i); [lia|]. ring.
    + rewrite product_at, unit_at by assumption. destruct (Nat.eqb_spec j i) as [->|]; ring.
Qed.
End Weights.
