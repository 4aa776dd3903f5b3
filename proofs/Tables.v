(** * The tables of a method, made once

    The definitions of Methods.v make a power of θ anew wherever they look at it. Here powers and
    multiples are in tables; the results are the same, to the letter. *)

From Coq Require Import QArith List Arith Lia Bool.
From Gark Require Import Stages Methods.
Import ListNotations.
Open Scope Q_scope.

(** ** Sums *)

Definition sum {X} (xs : list X) (f : X -> Q) := fold_right Qplus 0 (map f xs).

Lemma sum_ext {X} (xs : list X) f g : (forall a, In a xs -> f a == g a) -> sum xs f == sum xs g.
Proof.
  unfold sum. induction xs as [|a xs IH]; simpl; intros H; [reflexivity|].
  rewrite (H a (or_introl eq_refl)), IH; [reflexivity|]. intros; apply H; right; assumption.
Qed.
Lemma sum_plus {X} (xs : list X) f g : sum xs (fun a => f a + g a) == sum xs f + sum xs g.
Proof. unfold sum. induction xs; simpl; [reflexivity|]. rewrite IHxs. ring. Qed.
Lemma sum_times {X} (xs : list X) c f : sum xs (fun a => c * f a) == c * sum xs f.
Proof. unfold sum. induction xs; simpl; [ring|]. rewrite IHxs. ring. Qed.
Lemma sum_one {X} (a : X) f : sum [a] f == f a.
Proof. unfold sum. simpl. ring. Qed.
Lemma sum_app {X} (xs ys : list X) f : sum (xs ++ ys) f == sum xs f + sum ys f.
Proof. unfold sum. induction xs; simpl; [ring|]. rewrite IHxs. ring. Qed.
Lemma sum_map {X Y} (g : X -> Y) xs f : sum (map g xs) f == sum xs (fun a => f (g a)).
Proof. unfold sum. rewrite map_map. reflexivity. Qed.

Lemma sum_pairs {X Y} (xs : list X) (ys : list Y) f :
  sum (list_prod xs ys) f == sum xs (fun a => sum ys (fun c => f (a, c))).
Proof.
  induction xs as [|a xs IH]; [reflexivity|].
  simpl list_prod. rewrite sum_app, IH, sum_map. reflexivity.
Qed.
Lemma sum_swap {X Y} (xs : list X) (ys : list Y) f :
  sum xs (fun a => sum ys (fun c => f a c)) == sum ys (fun c => sum xs (fun a => f a c)).
Proof.
  induction xs as [|a xs IH].
  - rewrite (sum_ext ys _ (fun _ => 0 * 0)) by reflexivity. rewrite sum_times. unfold sum. simpl.
  ring.
  - change (sum ys (fun c => f a c) + sum xs (fun a => sum ys (fun c => f a c))
      == sum ys (fun c => f a c + sum xs (fun a => f a c))).
    rewrite sum_plus, IH. reflexivity.
Qed.
Lemma sum_of_products {X Y} (xs : list X) (ys : list Y) f g :
  sum (list_prod xs ys) (fun p => f (fst p) * g (snd p)) == sum xs f * sum ys g.
Proof.
  rewrite sum_pairs. simpl. transitivity (sum xs (fun a => sum ys g * f a)).
  - apply sum_ext. intros a _. rewrite sum_times. ring.
  - rewrite sum_times. ring.
Qed.
Lemma sum_at n i f : (i < n)%nat ->
  sum (seq 0 n) (fun a => (if Nat.eqb a i then 1 else 0) * f a) == f i.
Proof.
  intros H. induction n; [lia|]. rewrite seq_S, sum_app. unfold sum at 2. simpl.
  destruct (Nat.eqb_spec n i) as [->|D].
  - rewrite (sum_ext _ _ (fun _ => 0 * 0)).
    + rewrite sum_times. ring.
    + intros a I. apply in_seq in I. destruct (Nat.eqb_spec a i); [lia|ring].
  - rewrite IHn by lia. ring.
Qed.

(** ** Powers modulo a polynomial *)

Lemma nth_of_first {X} (xs : list X) n i x : (i < n)%nat -> nth i (firstn n xs) x = nth i xs x.
Proof.
  revert n i. induction xs as [|a xs IH]; intros [|n] [|i] H; simpl; try lia; try reflexivity.
  apply IH. lia.
Qed.

Lemma removelast_length (r : list Q) : length (removelast r) = (length r - 1)%nat.
Proof.
  induction r as [|a [|c r] IH]; [reflexivity|reflexivity|].
  change (S (length (removelast (c :: r))) = S (length r)). rewrite IH. simpl. lia.
Qed.
Lemma times_x_length m r : length r = length m -> length (times_x m r) = length m.
Proof.
  intros R. unfold times_x. rewrite map_length, combine_length. cbn [length].
  rewrite removelast_length. lia.
Qed.
Lemma power_length m n : length (power m n) = length m.
Proof.
  induction n; cbn [power]; [|apply times_x_length, IHn].
  rewrite firstn_length. simpl. rewrite repeat_length. lia.
Qed.

Lemma power_0 m i : (i < length m)%nat -> nth i (power m 0) 0 == if Nat.eqb i 0 then 1 else 0.
Proof.
  intros H. cbn [power]. rewrite nth_of_first by exact H.
  destruct i; [reflexivity|]. cbn [nth Nat.eqb]. rewrite nth_repeat. reflexivity.
Qed.

Lemma nth_removelast (r : list Q) i : (S i < length r)%nat -> nth i (removelast r) 0 = nth i r 0.
Proof.
  revert i. induction r as [|a r IH]; [simpl; lia|].
  destruct r as [|c r]; [simpl; lia|]. intros [|i] H; [reflexivity|].
  change (nth i (removelast (c :: r)) 0 = nth i (c :: r) 0). apply IH. simpl in *. lia.
Qed.
Lemma last_nth (r : list Q) : last r 0 = nth (length r - 1) r 0.
Proof.
  induction r as [|a r IH]; [reflexivity|]. destruct r as [|c r]; [reflexivity|].
  change (last (c :: r) 0 = nth (length r) (c :: r) 0).
  rewrite IH. f_equal. simpl. lia.
Qed.

Lemma times_x_at m r i : length r = length m -> (i < length m)%nat -> nth i (times_x m r) 0 ==
  (if Nat.eqb i 0 then 0 else nth (i - 1) r 0) - nth (length m - 1) r 0 * nth i m 0.
Proof.
  intros R H. unfold times_x. rewrite last_nth, R.
  set (f := fun '(a, c) => Qred (a - nth (length m - 1) r 0 * c)).
  assert (L : length (0 :: removelast r) = length m) by (simpl; rewrite removelast_length; lia).
  rewrite nth_indep with (d' := f (0, 0)) by (rewrite map_length, combine_length, L; lia).
  rewrite map_nth, combine_nth by exact L. unfold f. rewrite Qred_correct.
  destruct i; [reflexivity|]. cbn [nth Nat.eqb]. replace (S i - 1)%nat with i by lia.
  rewrite nth_removelast; [reflexivity|]. lia.
Qed.

Lemma power_S m n i : (i < length m)%nat -> nth i (power m (S n)) 0 ==
  (if Nat.eqb i 0 then 0 else nth (i - 1) (power m n) 0)
  - nth (length m - 1) (power m n) 0 * nth i m 0.
Proof. intros H. apply times_x_at; [apply power_length|exact H]. Qed.

Lemma power_small m n i : (n < length m)%nat -> (i < length m)%nat ->
  nth i (power m n) 0 == if Nat.eqb i n then 1 else 0.
Proof.
  revert i. induction n; intros i Hn H; [apply power_0, H|].
  rewrite power_S by exact H. rewrite (IHn (length m - 1)%nat) by lia.
  destruct (Nat.eqb_spec (length m - 1) n); [lia|].
  destruct (Nat.eqb_spec i 0) as [->|D]; [simpl; ring|].
  rewrite IHn by lia. replace (Nat.eqb (i - 1) n) with (Nat.eqb i (S n)); [ring|].
  apply Bool.eq_true_iff_eq. rewrite !Nat.eqb_eq. lia.
Qed.

(** ** Products *)

(** r, r x, r x^2, … modulo the polynomial m. *)
Fixpoint multiples (m r : list Q) (n : nat) : list (list Q) :=
  match n with O => [] | S n => r :: multiples m (times_x m r) n end.

Lemma nth_multiples m k : forall r n, (k < n)%nat ->
  nth k (multiples m r n) [] = Nat.iter k (times_x m) r.
Proof.
  induction k; intros r [|n] H; try lia; [reflexivity|]. cbn [multiples nth].
  rewrite IHk by lia. clear. induction k; [reflexivity|]. simpl. rewrite IHk. reflexivity.
Qed.
Lemma power_iter m n : power m n = Nat.iter n (times_x m) (power m 0).
Proof. induction n; [reflexivity|]. simpl in *. rewrite IHn. reflexivity. Qed.

Definition powers m := multiples m (power m 0) (2 * length m).
Lemma nth_powers m a c : (a < length m)%nat -> (c < length m)%nat ->
  nth (a + c) (powers m) [] = power m (a + c).
Proof. intros Ha Hc. unfold powers. rewrite nth_multiples by lia. symmetry. apply power_iter. Qed.

Definition is_zero (q : Q) : bool := Z.eqb (Qnum q) 0.
Lemma is_zero_0 q : is_zero q = true -> q == 0.
Proof. unfold is_zero, Qeq. intros H. apply Z.eqb_eq in H. rewrite H. reflexivity. Qed.

Lemma nonzero_pairs {X Y Z} (f : X * Y -> Z * Q) xs ys :
  nonzero (map f (list_prod xs ys)) =
  flat_map (fun x => nonzero (map (fun y => f (x, y)) ys)) xs.
Proof.
  unfold nonzero. induction xs as [|x xs IH]; [reflexivity|]. cbn [list_prod flat_map].
  rewrite map_app, filter_app, map_map, IH. reflexivity.
Qed.
Lemma nonzero_of_zeros {X Z} (f : X -> Z) (q : X -> Q) xs : (forall x, In x xs -> q x == 0) ->
  nonzero (map (fun x => (f x, q x)) xs) = [].
Proof.
  unfold nonzero. induction xs as [|x xs IH]; intros H; [reflexivity|]. cbn [map filter snd].
  rewrite (proj2 (Qeq_bool_iff _ _) (H x (or_introl eq_refl))). apply IH.
  intros y Hy. apply H. right. exact Hy.
Qed.
Lemma flat_map_same {X Y} (f g : X -> list Y) xs : (forall x, In x xs -> f x = g x) ->
  flat_map f xs = flat_map g xs.
Proof.
  induction xs as [|x xs IH]; intros H; [reflexivity|]. cbn [flat_map].
  rewrite (H x (or_introl eq_refl)), IH; [reflexivity|]. intros y Hy. apply H. right. exact Hy.
Qed.

Lemma nth_entry {X} n d (i e : nat) (f : nat * nat -> X) x : (i < n)%nat -> (e < d)%nat ->
  nth (i * d + e) (map f (list_prod (seq 0 n) (seq 0 d))) x = f (i, e).
Proof.
  intros Hi He. assert (G : forall k, nth (i * d + e) (map f (list_prod (seq k n) (seq 0 d)))
    x = f ((k + i)%nat, e)).
  { clear - Hi He. revert i Hi. induction n; [lia|]. intros i Hi k. cbn [seq list_prod].
    rewrite map_app, map_map. destruct i.
    - rewrite app_nth1 by (rewrite map_length, seq_length; lia). simpl.
      rewrite nth_indep with (d' := f (k, O)) by (rewrite map_length, seq_length; lia).
      rewrite (map_nth (fun y => f (k, y))), seq_nth by lia. rewrite Nat.add_0_r. reflexivity.
    - rewrite app_nth2 by (rewrite map_length, seq_length; simpl; lia).
      rewrite map_length, seq_length. replace (S i * d + e - d)%nat with (i * d + e)%nat by (simpl;
        lia).
      rewrite IHn by lia. f_equal. f_equal. lia. }
  rewrite (G 0%nat). reflexivity.
Qed.

Lemma bil_sum {X} (ps : list X) (f g : X -> nat) q x y :
  bil (nonzero (map (fun p => (f p, g p, Qred (q p))) ps)) x y ==
    sum ps (fun p => q p * x (f p) * y (g p)).
Proof.
  unfold sum. induction ps as [|p ps IH]; [reflexivity|]. cbn [map nonzero filter fold_right].
  cbn [snd]. rewrite <- IH. destruct (Qeq_bool (Qred (q p)) 0) eqn:E; cbn [negb bil].
  - apply Qeq_bool_iff in E. rewrite Qred_correct in E. rewrite E. unfold nonzero. ring.
  - unfold nonzero. rewrite Qred_correct. reflexivity.
Qed.

Section Tables.
Variable M : method.

Definition product_row_by (S F : list (list Q)) (s : space) (n : nat * nat) :=
  flat_map (fun '(a, u) => flat_map (fun c =>
      let q := match s with
        | Points _ => in_space s (fst n) a c
        | Modulo _ => nth (fst n) (nth (a + c) S []) 0 end in
      if is_zero q then [] else
        nonzero (map (fun v => (entry M (a, u), entry M (c, v),
            Qred (q * nth (snd n) (nth (u + v) F []) 0))) (seq 0 (degree M))))
    (seq 0 (size_of s))) (every M s).
Definition product_table (s : space) : list (list (nat * nat * Q)) :=
  let F := powers (field M) in
  let S := match s with Points _ => [] | Modulo m => powers m end in
  map (product_row_by S F s) (every M s).

Lemma product_table_is s : product_table s = product_of M s.
Proof.
  unfold product_table, product_of. apply map_ext. intros [i e].
  unfold product_row, product_row_by. rewrite nonzero_pairs. apply flat_map_same.
  intros [a u] I. unfold every in I. rewrite in_prod_iff, !in_seq in I.
  unfold every. rewrite nonzero_pairs. apply flat_map_same. intros c Ic. apply in_seq in Ic.
  assert (E : match s with
    | Points _ => in_space s (fst (i, e)) a c
    | Modulo _ => nth (fst (i, e)) (nth (a + c)
        match s with Points _ => [] | Modulo m => powers m end []) 0 end = in_space s i a c).
  { destruct s as [n|m]; [reflexivity|]. rewrite nth_powers by (simpl in *; lia). reflexivity. }
  cbv zeta. rewrite E. destruct (is_zero (in_space s i a c)) eqn:Z.
  - symmetry. apply (nonzero_of_zeros (fun v => (entry M (a, u), entry M (c, v)))
      (fun v => Qred (in_space s i a c * in_field M e u v))).
    intros v _. rewrite Qred_correct, (is_zero_0 _ Z). ring.
  - f_equal. apply map_ext_in. intros v Iv. apply in_seq in Iv. cbn [fst snd].
    rewrite nth_powers by (unfold degree in *; lia). reflexivity.
Qed.

(** ⊙ on numbers of ℚ(θ). *)
Lemma field_product e x y : (e < degree M)%nat -> bil (nth e (product_of M (Points 1)) []) x y ==
  sum (seq 0 (degree M)) (fun u => sum (seq 0 (degree M)) (fun v => in_field M e u v * x u * y v)).
Proof.
  intros He. unfold product_of.
  change (nth e (map ?f (every M (Points 1))) []) with (nth (0 * degree M + e) (map f (every M
    (Points 1))) []).
  unfold every at 1. rewrite nth_entry by (try exact He; simpl; lia). unfold product_row.
  cbn [fst snd].
  rewrite (map_ext _ (fun p => (entry M (fst p), entry M (snd p),
    Qred (in_space (Points 1) 0 (fst (fst p)) (fst (snd p)) * in_field M e (snd (fst p)) (snd (snd
      p))))))
    by (intros [[a u] [c v]]; reflexivity).
  rewrite bil_sum. unfold every. change (seq 0 (size_of (Points 1))) with [0%nat].
  rewrite !sum_pairs, sum_one. apply sum_ext. intros u _. rewrite !sum_pairs, sum_one.
  apply sum_ext. intros v _. unfold entry. cbn [fst snd in_space andb Nat.eqb Nat.mul Nat.add].
  ring.
Qed.

(** ** Blocks *)

Definition multiples_of (x : number) : list (list Q) :=
  if forallb is_zero x then []
  else multiples (field M) (map (fun w => Qred (nth w x 0)) (seq 0 (degree M))) (degree M).

Lemma start_at x e : (e < degree M)%nat ->
  nth e (map (fun w => Qred (nth w x 0)) (seq 0 (degree M))) 0 = Qred (nth e x 0).
Proof.
  intros H. rewrite nth_indep with (d' := Qred (nth 0%nat x 0)) by (rewrite map_length,
    seq_length; exact H).
  rewrite (map_nth (fun w => Qred (nth w x 0))), seq_nth by exact H. reflexivity.
Qed.

Lemma multiple_length r n : length r = degree M ->
  length (Nat.iter n (times_x (field M)) r) = degree M.
Proof. intros R. induction n; [exact R|]. apply times_x_length, IHn. Qed.

Lemma multiple_at x u : forall e, (e < degree M)%nat ->
  nth e (Nat.iter u (times_x (field M)) (map (fun w => Qred (nth w x 0)) (seq 0 (degree M)))) 0
  == sum (seq 0 (degree M)) (fun w => nth w x 0 * in_field M e w u).
Proof.
  induction u; intros e He.
  - cbn [Nat.iter nat_rect]. rewrite start_at, Qred_correct by exact He.
    rewrite (sum_ext _ _ (fun w => (if Nat.eqb w e then 1 else 0) * nth w x 0)).
    + rewrite sum_at by exact He. reflexivity.
    + intros w I. apply in_seq in I. unfold in_field.
    rewrite Nat.add_0_r, power_small by (unfold degree in *; lia).
      rewrite Nat.eqb_sym. ring.
  - change (Nat.iter (S u) ?f ?r) with (f (Nat.iter u f r)).
    rewrite times_x_at; [|apply multiple_length; rewrite map_length, seq_length; reflexivity|exact
      He].
    fold (degree M). rewrite (IHu (degree M - 1)%nat) by lia.
    symmetry.
    rewrite (sum_ext _ _ (fun w => (if Nat.eqb e 0 then 0 else nth w x 0 * in_field M (e - 1) w u)
      + (- nth e (field M) 0) * (nth w x 0 * in_field M (degree M - 1) w u))).
    + rewrite sum_plus, sum_times. destruct (Nat.eqb_spec e 0) as [->|D].
      * rewrite (sum_ext _ (fun _ => 0) (fun _ => 0 * 0)) by (intros; ring). rewrite sum_times.
      ring.
      * rewrite IHu by lia. ring.
    + intros w _. unfold in_field at 1. rewrite Nat.add_succ_r, power_S by exact He.
      unfold in_field. fold (degree M). destruct (Nat.eqb e 0); ring.
Qed.

Lemma reduced_at x u e : (e < degree M)%nat -> let y := nth e
  (Nat.iter u (times_x (field M)) (map (fun w => Qred (nth w x 0)) (seq 0 (degree M)))) 0 in Qred
    y = y.
Proof.
  intros He y. unfold y. destruct u.
  - cbn [Nat.iter nat_rect]. rewrite start_at by exact He. apply Qred_complete, Qred_correct.
  - change (Nat.iter (S u) ?f ?r) with (f (Nat.iter u f r)). unfold times_x at 1 3.
    set (g := fun '(a, c) => Qred _). set (ps := combine _ _).
    destruct (nth_in_or_default e (map g ps) 0) as [I|E]; [|rewrite E; reflexivity].
    apply in_map_iff in I. destruct I as [[a c] [<- _]]. apply Qred_complete, Qred_correct.
Qed.

Lemma coefficient_by x e u : (e < degree M)%nat -> (u < degree M)%nat ->
  nth e (nth u (multiples_of x) []) 0 = coefficient M x e u.
Proof.
  intros He Hu. unfold multiples_of, coefficient.
  fold (sum (seq 0 (degree M)) (fun w => nth w x 0 * in_field M e w u)).
  destruct (forallb is_zero x) eqn:Z.
  - rewrite forallb_forall in Z. replace (nth u [] []) with (@nil Q) by (destruct u; reflexivity).
    replace (nth e [] 0) with (Qred 0) by (destruct e; reflexivity). apply Qred_complete.
    rewrite (sum_ext _ _ (fun _ => 0 * 0)); [rewrite sum_times; ring|].
    intros w _. destruct (nth_in_or_default w x 0) as [I|E]; [rewrite (is_zero_0 _ (Z _
      I))|rewrite E]; ring.
  - rewrite nth_multiples by exact Hu. rewrite <- (reduced_at x u e He).
  apply Qred_complete, multiple_at, He.
Qed.

Definition row_by (xs : list (list (list Q))) (e : nat) : list (nat * Q) :=
  nonzero (flat_map (fun '(j, x) => map (fun u => (entry M (j, u), nth e (nth u x []) 0)) (seq 0
    (degree M)))
    (combine (seq 0 (length xs)) xs)).
(** The terms of Σ row_j x_j, for each coefficient of the result. *)
Definition row_table (row : list number) : list (list (nat * Q)) :=
  let xs := map multiples_of row in map (row_by xs) (seq 0 (degree M)).
Definition block_table (A : list (list number)) := flat_map row_table A.

Lemma row_table_is row : row_table row = map (block_row M row) (seq 0 (degree M)).
Proof.
  unfold row_table. cbv zeta. apply map_ext_in. intros e He. apply in_seq in He.
  unfold row_by, block_row. f_equal. rewrite map_length. generalize (seq 0 (length row)) as js.
  induction row as [|x row IH]; intros [|j js]; try reflexivity. cbn [map combine flat_map].
  rewrite IH. f_equal. apply map_ext_in. intros u Hu. apply in_seq in Hu.
  rewrite coefficient_by by lia. reflexivity.
Qed.
Lemma block_table_is A : block_table A = rows_of M A.
Proof. apply flat_map_ext. apply row_table_is. Qed.
End Tables.
